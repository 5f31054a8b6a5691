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
/// returns false. Consecutive parts may be in the same cell. Exact. O(log n + k) expected, with point locations for
/// those of the k items along the segment of which doubles cannot tell where it meets them.
void walk_directly(const FreeSpace& free, const Rational3& a, const Rational3& b,
                   const std::function<bool(const DirectPart&)>& visit);

/// True if all cells of the closed segment from a to b, which must differ, are allowed. As the walk, but told by the
/// first facet that the segment surely crosses into what is not allowed, wherever that is: a microsecond or so.
bool stays_directly(const FreeSpace& free, const Rational3& a, const Rational3& b,
                    const std::function<bool(CellId)>& allowed);

}  // namespace nef::planner
