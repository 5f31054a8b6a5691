// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/command/preview.h"

#include <filesystem>

#include "apps/view/picture.h"
#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

std::string picture_path(const std::string& directory, const std::string& name) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw InputError(directory + ": the folder cannot be created (" + error.message() + ")");
  return (std::filesystem::path(directory) / (name + ".png")).string();
}

// A cell moved away from the middle of all, so that the seams show.
ConvexCell apart(const ConvexCell& cell, const Rational3& middle) {
  Rational3 centre;
  for (const Rational3& p : cell.mesh.vertices) {
    for (std::size_t i = 0; i < 3; ++i) centre[i] += p[i];
  }
  Rational3 by;
  for (std::size_t i = 0; i < 3; ++i) {
    centre[i] /= static_cast<unsigned long>(cell.mesh.vertices.size());
    by[i] = (centre[i] - middle[i]) / 6;
  }
  return translated(cell, by);
}

}  // namespace

void write_previews(const std::string& directory, const std::vector<std::pair<std::string, Polyhedron>>& sets) {
  for (const auto& [name, set] : sets) {
    view::SceneOptions options;
    options.indices = false;
    std::vector<view::Layer> layers(1);
    layers[0].name = name;
    layers[0].scene = view::build_scene(set, options);
    view::write_picture(layers, picture_path(directory, name));
  }
}

void write_joint_preview(const std::string& directory, const std::string& name,
                         const std::vector<std::pair<std::string, Polyhedron>>& sets) {
  std::vector<view::Layer> layers;
  view::SceneOptions options;
  options.indices = false;
  for (const auto& [layer_name, set] : sets) {
    view::Layer& layer = layers.emplace_back();
    layer.name = layer_name;
    layer.scene = view::build_scene(set, options);
    layer.color = view::palette_color(layers.size() - 1);
  }
  view::write_picture(layers, picture_path(directory, name));
}

void write_cell_preview(const std::string& directory, std::span<const ConvexCell> cells) {
  Rational3 middle;
  std::size_t count = 0;
  for (const ConvexCell& cell : cells) {
    for (const Rational3& p : cell.mesh.vertices) {
      for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i];
      ++count;
    }
  }
  for (Rational& x : middle) x /= static_cast<unsigned long>(std::max<std::size_t>(count, 1));
  std::vector<view::Layer> layers;
  view::SceneOptions options;
  options.indices = false;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    view::Layer& layer = layers.emplace_back();
    layer.name = "cell " + std::to_string(i + 1);
    layer.scene = view::build_scene(to_polyhedron(apart(cells[i], middle)), options);
    layer.color = view::palette_color(i);
  }
  view::write_picture(layers, picture_path(directory, "cells"));
}

}  // namespace nef::minkowski
