// SPDX-License-Identifier: Apache-2.0
//
// Distance to what is not free, in doubles.
#pragma once

#include <vector>

#include "apps/planner/free_space/free_space.h"
#include "apps/planner/intersection/vectors.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::planner {

/// The walls of free space in a tree of boxes.
class ClearanceField {
 public:
  /// O(n log n). The free space need not outlive it.
  explicit ClearanceField(const FreeSpace& free);

  /// Distance from a point to the nearest boundary facet, infinite if there is none. Doubles: an
  /// estimate with an error of a few ulps of the coordinates. O(log n) expected.
  [[nodiscard]] double distance(const Vector3d& point) const;

 private:
  std::vector<std::array<Vector3d, 3>> triangles_;
  BoxTree boxes_;
};

}  // namespace nef::planner
