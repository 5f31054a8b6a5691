// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/command/preview.h"

#include <filesystem>

#include "apps/view/picture.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

std::string picture_path(const std::string& directory, const std::string& name) {
  make_folder(directory);
  return (std::filesystem::path(directory) / (name + ".png")).string();
}

view::Layer layer_of(const std::string& name, const Polyhedron& set) {
  view::SceneOptions options;
  options.indices = false;
  view::Layer layer;
  layer.name = name;
  layer.scene = view::build_scene(set, options);
  return layer;
}

}  // namespace

void write_previews(const std::string& directory, const std::vector<std::pair<std::string, Polyhedron>>& sets) {
  for (const auto& [name, set] : sets) view::write_picture({layer_of(name, set)}, picture_path(directory, name));
}

void write_joint_preview(const std::string& directory, const std::string& name,
                         const std::vector<std::pair<std::string, Polyhedron>>& sets) {
  std::vector<view::Layer> layers;
  for (const auto& [layer_name, set] : sets) {
    layers.push_back(layer_of(layer_name, set));
    layers.back().color = view::palette_color(layers.size() - 1);
  }
  view::write_picture(layers, picture_path(directory, name));
}

void write_cell_preview(const std::string& directory, std::span<const ConvexCell> cells) {
  std::vector<Rational3> all;
  for (const ConvexCell& cell : cells) {
    all.insert(all.end(), cell.mesh.vertices.begin(), cell.mesh.vertices.end());
  }
  std::vector<std::pair<std::string, Polyhedron>> apart;  // moved away from the middle of all, so that seams show
  for (const ConvexCell& cell : cells) {
    Rational3 by = minus(mean_of<Rational>(cell.mesh.vertices), mean_of<Rational>(all));
    for (Rational& x : by) x /= 6;
    apart.emplace_back("cell " + std::to_string(apart.size() + 1), to_polyhedron(translated(cell, by)));
  }
  write_joint_preview(directory, "cells", apart);
}

}  // namespace nef::minkowski
