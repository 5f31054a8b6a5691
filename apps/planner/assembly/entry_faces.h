// SPDX-License-Identifier: Apache-2.0
//
// Which of two solids is in the way of the other, along one direction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/geometry/search/box_tree.h"
#include "nef/mesh/mesh.h"
#include "nef/number/approximation.h"
#include "nef/number/number.h"

namespace nef::planner {

/// The faces through which rays of a direction enter a solid, projected along it. A line of the direction that meets no
/// edge is in the inside of the solid on intervals, each of which begins at such a face. The mesh must outlive this.
class EntryFaces {
 public:
  /// The mesh must consist of the triangles around a solid. O(n log n).
  EntryFaces(const Mesh& triangles, const Rational3& direction, const Monitor& monitor = {});

  /// Whether this solid, moved along the direction, overlaps another one somewhere on its way to infinity: whether a
  /// line of the direction enters this solid before the other one. The two must not overlap where they are. Exact;
  /// doubles leave out most pairs of faces, O(n log n + k) for k pairs that lie before each other.
  [[nodiscard]] bool is_before(const EntryFaces& other, const Monitor& monitor = {}) const;

 private:
  using Triangle = std::array<std::uint32_t, 3>;  // vertices, counterclockwise in the projection
  using Point = Rational3;                        // two coordinates of the projection, and how far along the direction

  [[nodiscard]] Point projected(std::uint32_t vertex) const;
  [[nodiscard]] bool surely_beside(const Triangle& own, const EntryFaces& other, const Triangle& others) const;
  [[nodiscard]] bool exactly_before(const Triangle& own, const EntryFaces& other, const Triangle& others) const;

  const Mesh& mesh_;
  Rational3 direction_;
  std::size_t axis_ = 0;  // the largest coordinate of the direction
  std::vector<Approximation3> points_;
  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace nef::planner
