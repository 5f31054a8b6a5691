// SPDX-License-Identifier: Apache-2.0
//
// What can be seen of polygons in the same direction from one point: a filter for the many faces around a vertex of
// high degree, whose boxes all overlap.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"

namespace nef {

/// Convex polygons of at most three corners (points, segments, triangles) as they are seen from a centre: on the faces
/// of a cube around it, where lines are seen as lines. Two polygons that have a point besides the centre in common are
/// seen in one direction at least, so what a query does not find has none.
///
/// In doubles, with proven bounds (direction_tree.cpp). O(n log n) to build; a query is O(log n + hits) expected.
class DirectionTree {
 public:
  /// The coordinates of `centre` and of all points are within `margin` + 2^-50 relative of the truth.
  DirectionTree(const Double3& centre, double margin) : centre_(centre), margin_(margin) {}

  /// Adds a polygon of an item, before build(). Returns false, and adds nothing, if it comes so close to the centre
  /// that it may be seen anywhere.
  bool add(std::uint32_t item, std::span<const Double3> polygon);

  /// True if add() would add it.
  [[nodiscard]] bool sees(std::span<const Double3> polygon) const { return seen(polygon).has_value(); }

  /// To be called once, after all polygons have been added.
  void build();

  /// Appends the items with polygons that may be seen in a direction of this polygon; an item may be appended more than
  /// once. Returns false, and appends nothing, if that may be all of them.
  [[nodiscard]] bool find(std::span<const Double3> polygon, std::vector<std::uint32_t>& items) const;

 private:
  // What is seen on a face of the cube: a convex polygon, and its box; no corners where nothing is seen.
  struct Shape {
    std::array<std::array<double, 2>, 12> corners{};
    std::size_t count = 0;
    Box box;

    void add(const std::array<double, 2>& corner);
    [[nodiscard]] std::span<const std::array<double, 2>> polygon() const { return std::span(corners).first(count); }
  };
  using Seen = std::array<Shape, 6>;
  struct Face {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> item_of;
    std::vector<std::array<double, 2>> corners;
    std::vector<std::uint32_t> corner_begin{0};  // of each box
    BoxTree tree;
  };
  [[nodiscard]] std::optional<Seen> seen(std::span<const Double3> polygon) const;

  Double3 centre_;
  double margin_;
  std::array<Face, 6> faces_;
};

}  // namespace nef
