// SPDX-License-Identifier: Apache-2.0
//
// What the command line says.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/visual_hull.h"
#include "nef/program/common_options.h"

namespace visual_hull {

/// The options as they were given; see add_options for their meaning.
struct Arguments {
  std::string scene;
  std::string output;
  bool exact = false;
  bool binary = false;
  bool text = false;
  nef::MeshFileFlags mesh_file;  ///< --lenient and --recenter; --manifold is below
  std::size_t decimate = 0;      ///< triangles; 0: not
  double min_area = 0;
  double simplify = 0;
  bool outer = false;
  bool manifold = false;
  bool color = false;
  std::string border = "outside";
  std::string box;
  std::string origin;
  std::string up;
  std::string matrices;
  std::optional<int> turntable;
  std::vector<double> intrinsics;
  std::optional<double> radius;
  double height = 0;
  std::string threshold;
  bool invert = false;
  std::string channel;
  std::vector<std::string> silhouettes;
  std::string images;
  std::string frames;
  std::string overlay;
  std::string preview;
  std::string page;
  std::string report;
  bool check = false;
  bool verify = false;
  std::string way = "best";
  bool suspects = false;
  bool drop_suspects = false;
  std::size_t at_least = 0;  ///< 0: all
  bool exact_volume = false;
  unsigned threads = 0;
  bool json = false;
  bool quiet = false;
};

/// Declares all options, the version, the footer of the help.
void add_options(CLI::App& app, Arguments& arguments);

/// Throws InputError for values that mean nothing.
Options to_options(const Arguments& arguments);

/// The scene that the arguments name, its axes turned, polygons of --silhouette in place of images. Throws InputError.
Scene scene_of(const Arguments& arguments);

/// Puts the polygons of --silhouette in place of images. Throws InputError.
void take_silhouettes(Scene& scene, const std::vector<std::string>& arguments);

}  // namespace visual_hull
