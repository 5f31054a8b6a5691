// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/cells/meeting_points.h"

#include <algorithm>

#include "nef/geometry/predicates.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef::minkowski {

PointId MeetingPoints::first_equal(PointId point) {
  const std::uint64_t hash = points_.hash(point);
  const auto [first, last] = seen_.equal_range(hash);
  for (auto at = first; at != last; ++at) {
    if (points_.identical(PointId{at->second}, point)) return PointId{at->second};
  }
  seen_.emplace(hash, point.index());
  return point;
}

std::optional<Meeting> MeetingPoints::meet(const std::array<PlaneId, 3>& planes) {
  std::array<std::uint32_t, 3> rows = {planes[0].row(), planes[1].row(), planes[2].row()};
  std::sort(rows.begin(), rows.end());
  if (rows[0] == rows[1] || rows[1] == rows[2]) return std::nullopt;
  const auto [tried, is_first] = tried_.emplace(rows, kNone);
  if (!is_first) {
    if (tried->second == kNone) return std::nullopt;
    return Meeting{PointId{tried->second}, false, true, 0};
  }
  const std::optional<PointId> raw = raw_.push_intersection(planes_, planes[0], planes[1], planes[2]);
  if (!raw) return std::nullopt;
  const std::size_t limbs = mpz_size(raw_.coordinate(*raw, 3));
  // Without a common factor equal points have equal coordinates.
  const PointId pushed = points_.push_reduced(raw_, *raw);
  raw_.pop();
  const PointId point = first_equal(pushed);
  const bool is_new = point == pushed;
  if (!is_new) points_.pop();
  tried->second = point.index();
  return Meeting{point, is_new, false, limbs};
}

}  // namespace nef::minkowski
