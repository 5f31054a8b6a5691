// SPDX-License-Identifier: Apache-2.0
//
// Faces that are damaged as those of bad files are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fuzz/choices.h"
#include "nef/mesh/mesh.h"

namespace nef::fuzz {

using FaceRing = std::vector<std::uint32_t>;

/// The faces of a mesh in the making.
class FaceRings {
 public:
  explicit FaceRings(Choices& choices) : choices_(choices) {}

  /// Without faces that have no corners.
  [[nodiscard]] Mesh mesh() const {
    Mesh mesh;
    mesh.vertices = vertices_;
    for (const FaceRing& ring : rings_) {
      if (!ring.empty()) mesh.push_face(ring);
    }
    return mesh;
  }

 protected:
  /// Turns a face over, or adds a copy, turned alike or over.
  enum Whole : std::uint32_t { kTurn, kCopy, kCopyTurned };
  void damage_whole(std::uint32_t how, FaceRing& ring) {
    if (how == kTurn) {
      std::reverse(ring.begin(), ring.end());
    } else if (how == kCopy) {
      rings_.push_back(FaceRing(ring));
    } else {
      rings_.emplace_back(ring.rbegin(), ring.rend());
    }
  }

  /// Gives a corner a vertex of its own at the same place.
  void give_own_vertex(FaceRing& ring, std::uint32_t at) {
    vertices_.push_back(Rational3(vertices_[ring[at]]));
    ring[at] = static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  /// Puts a corner into the side that begins at another one, which the neighbour does not have.
  void cut_side(FaceRing& ring, std::uint32_t at) {
    ring.insert(ring.begin() + at + 1, push_middle(ring[at], ring[(at + 1) % ring.size()]));
  }

  /// Adds a face without area along that side.
  void add_without_area(const FaceRing& ring, std::uint32_t at) {
    const std::uint32_t next = ring[(at + 1) % ring.size()];
    rings_.push_back({ring[at], push_middle(ring[at], next), next});
  }

  FaceRing& any_ring() { return rings_[choices_.below(static_cast<std::uint32_t>(rings_.size()))]; }

  Choices& choices_;
  std::vector<Rational3> vertices_;
  std::vector<FaceRing> rings_;

 private:
  std::uint32_t push_middle(std::uint32_t u, std::uint32_t v) {
    Rational3 middle;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = (vertices_[u][i] + vertices_[v][i]) / 2;
    vertices_.push_back(middle);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }
};

}  // namespace nef::fuzz
