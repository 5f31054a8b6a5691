// SPDX-License-Identifier: Apache-2.0
//
// What the command line says.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/session.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// The command line: what all programs have in `session` (output, report, flags of files), and the rest; see
/// add_options for what it means.
struct Arguments {
  explicit Arguments(nef::Session& its_session) : session(its_session) {}

  nef::Session& session;
  std::string scene;
  std::size_t decimate = 0;  ///< triangles; 0: not
  double min_area = 0;
  bool soft = false;
  double simplify = 0;
  bool outer = false;
  bool color = false;
  bool texture = false;
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
  std::string mask;
  bool repair_masks = false;
  bool invert = false;
  std::string channel;
  std::vector<std::string> silhouettes;
  std::string images;
  std::vector<std::string> without;
  std::string frames;
  std::string overlay;
  std::string page;
  std::string picture;
  std::string points;
  std::size_t samples = 100000;
  std::string hull_masks;
  bool check = false;
  bool verify = false;
  bool largest = false;
  std::string way = "best";
  bool refine = false;
  std::string refined_scene;
  bool suspects = false;
  bool drop_suspects = false;
  std::size_t at_least = 0;  ///< 0: all
  bool exact_volume = false;
};

/// The methods of --mask, for the help.
std::string mask_help();

/// Declares the options that say how images become silhouettes.
void add_mask_options(CLI::App& app, Arguments& arguments);

/// Declares all options, the version, the footer of the help.
void add_options(CLI::App& app, Arguments& arguments);

/// Throws InputError for values that mean nothing.
Options to_options(const Arguments& arguments);

/// The scene that the arguments name, its axes turned, polygons of --silhouette in place of images. Throws InputError.
Scene scene_of(const Arguments& arguments);

/// The folder of --images, if the scene of scene_of has not got its images from there already.
std::optional<std::filesystem::path> images_folder(const Arguments& arguments);

/// Puts the polygons of --silhouette in place of images. Throws InputError.
void take_silhouettes(Scene& scene, const std::vector<std::string>& arguments);

}  // namespace nef::visual_hull
