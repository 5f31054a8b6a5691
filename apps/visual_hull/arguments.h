// SPDX-License-Identifier: Apache-2.0
//
// What the command line says.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/visual_hull/visual_hull.h"

namespace visual_hull {

/// The options as they were given; see add_options for their meaning.
struct Arguments {
  std::string scene;
  std::string output;
  bool exact = false;
  bool binary = false;
  bool text = false;
  double min_area = 0;
  double simplify = 0;
  bool outer = false;
  std::string border = "outside";
  std::string box;
  std::string origin = "center";
  std::string threshold;
  bool invert = false;
  std::string channel;
  std::vector<std::string> silhouettes;
  std::string images;
  std::string overlay;
  std::string preview;
  std::string page;
  std::string report;
  bool verify = false;
  unsigned threads = 0;
  bool json = false;
  bool quiet = false;
};

/// Declares all options, the version, the footer of the help.
void add_options(CLI::App& app, Arguments& arguments);

/// Throws InputError for values that mean nothing.
Options to_options(const Arguments& arguments);

/// Puts the polygons of --silhouette in place of images. Throws InputError.
void take_silhouettes(Scene& scene, const std::vector<std::string>& arguments);

}  // namespace visual_hull
