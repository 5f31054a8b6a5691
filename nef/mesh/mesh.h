// SPDX-License-Identifier: Apache-2.0
//
// Polygon meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// A polygon mesh with exact coordinates. Face f has the vertices
/// corners[face_begin[f]] .. corners[face_begin[f+1]-1], counterclockwise as seen from outside.
struct Mesh {
  std::vector<Rational3> vertices;
  std::vector<std::uint32_t> face_begin{0};
  std::vector<std::uint32_t> corners;

  [[nodiscard]] std::size_t face_count() const { return face_begin.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> face(std::size_t f) const {
    return {corners.data() + face_begin[f], face_begin[f + 1] - face_begin[f]};
  }
  void push_face(std::span<const std::uint32_t> face) {
    corners.insert(corners.end(), face.begin(), face.end());
    face_begin.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

/// Calls visit(u, v) for each side of a face, given by its corners: from u to v.
template <typename Visit>
void for_each_side(std::span<const std::uint32_t> face, Visit&& visit) {
  for (std::size_t i = 0; i < face.size(); ++i) visit(face[i], face[i + 1 == face.size() ? 0 : i + 1]);
}

}  // namespace nef
