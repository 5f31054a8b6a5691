// SPDX-License-Identifier: Apache-2.0
//
// Which cells a segment runs through, without a partition of space: slower than segment_walk.h by some microseconds a
// segment, but there is nothing to build beforehand.
#pragma once

#include <functional>

#include "apps/planner/free_space/free_space.h"

namespace nef::planner {

/// A part of a segment inside one cell: a single parameter (begin == end) or the open interval between two.
struct DirectPart {
  CellId cell = kNoCell;
  bool is_point = false;
  const Rational& begin;
  const Rational& end;
};

/// Calls visit(part) for the parts of the closed segment from a to b in order; the points must differ. Stops when visit
/// returns false. Consecutive parts may be in the same cell. Exact. O(log n + k) expected, with a point location for
/// each of the k items that the segment meets or nearly meets.
void walk_directly(const FreeSpace& free, const Rational3& a, const Rational3& b,
                   const std::function<bool(const DirectPart&)>& visit);

}  // namespace nef::planner
