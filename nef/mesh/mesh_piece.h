// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "nef/mesh/mesh.h"

namespace nef {

/// Makes a mesh of some faces with the vertices that they use, in the order of their first use. The vertices that faces
/// name must outlive it.
class MeshPiece {
 public:
  explicit MeshPiece(std::span<const Rational3> vertices) : vertices_(vertices) {}

  /// Adds a face, given by its corners among the vertices. O(corners) expected.
  void push(std::span<const std::uint32_t> corners) {
    ring_.clear();
    for (const std::uint32_t v : corners) {
      const auto [at, is_new] = number_.emplace(v, static_cast<std::uint32_t>(piece_.vertices.size()));
      if (is_new) piece_.vertices.push_back(vertices_[v]);
      ring_.push_back(at->second);
    }
    piece_.push_face(ring_);
  }

  /// The mesh; nothing is left here.
  [[nodiscard]] Mesh take() { return std::move(piece_); }

 private:
  std::span<const Rational3> vertices_;
  Mesh piece_;
  std::unordered_map<std::uint32_t, std::uint32_t> number_;
  std::vector<std::uint32_t> ring_;
};

}  // namespace nef
