// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "nef/mesh/mesh.h"

namespace nef::test {

/// What keeps a mesh, its vertices told apart by their numbers alone, from being a closed, oriented two-manifold; the
/// empty string if nothing does. Counted, not computed: every directed edge once, and its opposite; one fan a vertex.
inline std::string not_two_manifold(const Mesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> face_of;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::array edge{face[k], face[(k + 1) % face.size()]};
      if (!face_of.emplace(edge, f).second) {
        return "edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]) + " twice in one direction";
      }
    }
  }
  std::vector<std::size_t> corners(mesh.vertices.size(), 0);
  for (const std::uint32_t v : mesh.corners) ++corners[v];
  for (const auto& [edge, f] : face_of) {
    if (!face_of.contains({edge[1], edge[0]})) return "an open edge at vertex " + std::to_string(edge[0]);
  }
  // Around the first vertex of each edge: across the side by which a face comes back to it, on and on.
  std::vector<bool> done(mesh.vertices.size(), false);
  for (const auto& [edge, f] : face_of) {
    const std::uint32_t v = edge[0];
    if (done[v]) continue;
    done[v] = true;
    std::size_t passed = 0;
    std::array<std::uint32_t, 2> at = edge;
    do {
      const auto face = mesh.face(face_of.at(at));
      std::size_t k = 0;
      while (face[k] != v) ++k;
      at = {v, face[(k + face.size() - 1) % face.size()]};
      ++passed;
    } while (at != edge && passed <= corners[v]);
    if (passed != corners[v]) return "several fans at vertex " + std::to_string(v);
  }
  return "";
}

}  // namespace nef::test
