// SPDX-License-Identifier: Apache-2.0
//
// Where tiles are cut: axis-parallel planes, and the boxes between them.
#pragma once

#include <array>
#include <memory>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/number/number.h"

namespace nef {

/// The plane x[axis] = at.
struct AxisPlane {
  std::size_t axis = 0;
  Rational at;
  std::array<double, 2> bounds{};  ///< two doubles that `at` lies between, inclusive

  AxisPlane() = default;
  AxisPlane(std::size_t axis, Rational at);

  /// Interns it; its positive side is where x[axis] is greater.
  PlaneId intern(PlaneTable& planes) const;

  /// -1 or +1 if the box surely lies strictly below or above the plane; 0 otherwise.
  [[nodiscard]] int side(const Box& box) const {
    return box.high[axis] < bounds[0] ? -1 : box.low[axis] > bounds[1] ? 1 : 0;
  }
  bool operator==(const AxisPlane& other) const { return axis == other.axis && at == other.at; }
};

/// A closed box whose sides are axis planes, or nothing where it is unbounded. It refers to the planes, which must
/// outlive it: the identity of a wall tells which cut made it.
struct Region {
  std::array<const AxisPlane*, 3> low{};
  std::array<const AxisPlane*, 3> high{};

  /// The parts on both sides of a plane through its interior.
  [[nodiscard]] Region below(const AxisPlane& plane) const;
  [[nodiscard]] Region above(const AxisPlane& plane) const;

  /// True if it is all of space.
  [[nodiscard]] bool unbounded() const;
};

/// The complex of a region that has the same mark everywhere, kOutside beyond it; without an infimaximal box, and so
/// without vertices, if the region is all of space.
Complex uniform_tile(const Region& region, LabelId mark, const Monitor& monitor);

/// The eight corners of the infimaximal box, each with the map of an octant of the given mark. Their links are those of
/// a box; they use the planes of the result.
Complex infimaximal_corners(LabelId mark, const Monitor& monitor);

}  // namespace nef
