// SPDX-License-Identifier: Apache-2.0
//
// Where an edge pierces a plane, in double precision with proven bounds: most edges that pass
// through the plane of a facet miss the facet by far, and need no exact point to know it.
#pragma once

#include "nef/geometry/box_tree.h"
#include "nef/geometry/predicates.h"

namespace nef {

/// A box that holds the point where the segment ab, whose ends lie strictly on two sides of the
/// plane, passes through it. Infinite where the doubles do not tell.
Box piercing_box(const PlaneTable& planes, PlaneId plane, const PointTable& points, PointId a, PointId b);

/// Parity of the boundary edges of a facet, shown one after the other, along a ray toward smaller
/// `first` coordinates from a point that is known up to a box.
class RoughParity {
 public:
  RoughParity(const Box& point, int first, int second);

  /// Counts an edge between two points known by their doubles.
  void add(const std::array<double, 3>& a, const std::array<double, 3>& b);

  /// True if the point surely lies outside: every edge was decided, and their number is even.
  [[nodiscard]] bool surely_outside() const { return certain_ && !inside_; }
  [[nodiscard]] bool certain() const { return certain_; }

 private:
  std::size_t first_;
  std::size_t second_;
  double low_[2];  // of the point: first, second
  double high_[2];
  bool certain_ = true;
  bool inside_ = false;
};

}  // namespace nef
