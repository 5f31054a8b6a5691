// SPDX-License-Identifier: Apache-2.0
//
// Meshes of the benchmarks' cases for the Manifold library.
#pragma once

#include <manifold/manifold.h>

#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nef::bench {

/// A coordinate as cases write it: a number or a quotient p/q of two.
inline double read_coordinate(const std::string& word) {
  const std::size_t slash = word.find('/');
  const double value = std::stod(word);
  return slash == std::string::npos ? value : value / std::stod(word.substr(slash + 1));
}

/// An OFF file of a case. Manifold takes triangles only; the polygons of our cases are convex and become fans. Throws
/// std::runtime_error if the file is not OFF or ends too early.
inline manifold::MeshGL64 read_off(const std::string& path) {
  std::ifstream in(path);
  std::string word;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  if (!(in >> word >> vertices >> faces >> edges) || word != "OFF") throw std::runtime_error(path + ": not OFF");
  manifold::MeshGL64 mesh;
  mesh.numProp = 3;
  mesh.vertProperties.reserve(3 * vertices);
  mesh.triVerts.reserve(3 * faces);
  for (std::size_t i = 0; i < 3 * vertices && in >> word; ++i) mesh.vertProperties.push_back(read_coordinate(word));
  std::vector<std::size_t> face;
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t count = 0;
    if (!(in >> count)) break;
    face.resize(count);
    for (std::size_t& corner : face) in >> corner;
    for (std::size_t i = 2; i < count; ++i) {
      for (const std::size_t corner : {face[0], face[i - 1], face[i]}) mesh.triVerts.push_back(corner);
    }
  }
  if (!in) throw std::runtime_error(path + ": ends too early");
  return mesh;
}

}  // namespace nef::bench
