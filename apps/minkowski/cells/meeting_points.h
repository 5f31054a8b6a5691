// SPDX-License-Identifier: Apache-2.0
//
// Points where three planes meet, each once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "nef/geometry/point_table.h"

namespace nef::minkowski {

/// Where three planes meet.
struct Meeting {
  PointId point{0};
  bool is_new = false;        ///< no point with these coordinates was known
  bool planes_known = false;  ///< the same planes were asked for before
  std::size_t limbs = 0;      ///< of the divisor as it was computed, for estimates of time; 0 for known planes
};

/// Finds meetings and gives equal points one name. Not to be shared between threads.
class MeetingPoints {
 public:
  /// Both must outlive the object; new points are added to the table.
  MeetingPoints(const PlaneTable& planes, PointTable& points) : planes_(planes), points_(points) {}

  /// The first point of the table with the same coordinates that was given here, which may be the point itself. Points
  /// given here must have no common factor in their coordinates.
  PointId first_equal(PointId point);

  /// Nothing if two planes are in one row, or they do not meet in a point. O(1) exact steps, none for known planes.
  std::optional<Meeting> meet(const std::array<PlaneId, 3>& planes);

 private:
  struct TripleHash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& t) const {
      std::uint64_t h = t[0];
      for (const std::uint32_t x : {t[1], t[2]}) h = (h ^ (h >> 29U)) * 0x9e3779b97f4a7c15ULL + x;
      return h ^ (h >> 32U);
    }
  };

  const PlaneTable& planes_;
  PointTable& points_;
  PointTable raw_;                                                                     // the meeting at hand
  std::unordered_multimap<std::uint64_t, std::uint32_t> seen_;                         // hash of coordinates -> point
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, TripleHash> tried_;  // rows -> point or kNone
};

}  // namespace nef::minkowski
