// SPDX-License-Identifier: Apache-2.0
//
// Exact questions about segments in free space.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "apps/planner/free_space/free_space.h"

namespace nef::planner {

/// Which cells a path may use: all free ones, or fewer.
class CellFilter {
 public:
  /// All free cells where free space is locally at least this thick.
  explicit CellFilter(const FreeSpace& free, int min_dimension = 0);
  void forbid(CellId cell) { allowed_[cell] = false; }
  void allow(CellId cell) { allowed_[cell] = true; }
  [[nodiscard]] bool operator()(CellId cell) const { return cell != kNoCell && allowed_[cell]; }

 private:
  std::vector<bool> allowed_;
};

/// True if all of the closed segment lies in allowed cells. Exact; about a microsecond where the
/// double filter decides.
bool segment_allowed(const FreeSpace& free, const CellFilter& filter, const Rational3& a, const Rational3& b);

/// Where a motion from a to b hits what is not free.
struct Contact {
  Rational parameter;     ///< the motion is free up to here (excluded if the hit point itself is not free)
  Rational last_free;     ///< a free parameter: `parameter` itself if that is free, else one shortly before
  CellId cell = kNoCell;  ///< the cell that is hit
};
/// The first part of the segment that is not free; nothing if there is none.
std::optional<Contact> first_contact(const FreeSpace& free, const ExactPoint& a, const ExactPoint& b);

/// True if all segments of a way are.
bool way_allowed(const FreeSpace& free, const CellFilter& filter, std::span<const Rational3> way);

/// A position on the first part of the closed segment that is not free; nothing if all of it is free.
std::optional<Rational3> first_blocked_position(const FreeSpace& free, const Rational3& a, const Rational3& b);

/// The different cells along the closed segment in order.
struct CellOnSegment {
  CellId cell = kNoCell;
  bool is_point = false;  ///< crossed in one point only
};
std::vector<CellOnSegment> cells_along(const FreeSpace& free, const Rational3& a, const Rational3& b);

/// Euclidean length, nearest double up to rounding of the coordinates' differences.
double distance(const Rational3& a, const Rational3& b);

}  // namespace nef::planner
