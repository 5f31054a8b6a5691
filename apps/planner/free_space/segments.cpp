// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/segments.h"

#include <cmath>

#include "apps/planner/free_space/direct_walk.h"
#include "apps/planner/partition/segment_walk.h"

namespace nef::planner {

CellFilter::CellFilter(const FreeSpace& free, int min_dimension) : allowed_(free.cells().size()) {
  for (CellId cell = 0; cell < allowed_.size(); ++cell) {
    allowed_[cell] = free.is_free(cell) && free.local_dimension(cell) >= min_dimension;
  }
}

bool segment_allowed(const FreeSpace& free, const CellFilter& filter, const Rational3& a, const Rational3& b) {
  const ExactPoint pa(a);
  const ExactPoint pb(b);
  if (a == b) return filter(free.locate(pa));
  if (!free.has_roadmap()) return stays_directly(free, a, b, std::cref(filter));
  bool allowed = true;
  walk_segment(free.tree(), pa, pb, [&](const SegmentPart& part) { return allowed = filter(part.cell); });
  return allowed;
}

bool way_allowed(const FreeSpace& free, const CellFilter& filter, std::span<const Rational3> way) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    if (!segment_allowed(free, filter, way[i], way[i + 1])) return false;
  }
  return true;
}

std::optional<Contact> first_contact(const FreeSpace& free, const ExactPoint& a, const ExactPoint& b) {
  const ExactSegment segment(free.tree().planes(), a, b);
  std::optional<Contact> contact;
  SegmentParameter before = ExactSegment::fixed(0);
  walk_segment(free.tree(), a, b, [&](const SegmentPart& part) {
    if (free.is_free(part.cell)) {
      before = part.begin;
      return true;
    }
    const Rational begin = segment.exact(part.begin);
    contact = Contact{begin, begin, part.cell};
    if (part.is_point) contact->last_free = (segment.exact(before) + begin) / 2;
    return false;
  });
  return contact;
}

namespace {

// Calls visit(cell, is_point, middle) for the parts of a closed segment in order, middle() being the exact parameter in
// the middle of one, until it returns false.
template <typename Visit>
void for_each_part(const FreeSpace& free, const Rational3& a, const Rational3& b, const Visit& visit) {
  const ExactPoint pa(a);
  const ExactPoint pb(b);
  if (a == b) {
    visit(free.locate(pa), true, [] { return Rational(0); });
  } else if (free.has_roadmap()) {
    const ExactSegment segment(free.tree().planes(), pa, pb);
    walk_segment(free.tree(), pa, pb, [&](const SegmentPart& part) {
      return visit(part.cell, part.is_point,
                   [&]() -> Rational { return (segment.exact(part.begin) + segment.exact(part.end)) / 2; });
    });
  } else {
    walk_directly(free, a, b, [&](const DirectPart& part) {
      return visit(part.cell, part.is_point, [&]() -> Rational { return (part.begin + part.end) / 2; });
    });
  }
}

}  // namespace

std::optional<Rational3> first_blocked_position(const FreeSpace& free, const Rational3& a, const Rational3& b) {
  std::optional<Rational3> result;
  for_each_part(free, a, b, [&](CellId cell, bool /*is_point*/, const auto& middle) {
    if (!free.is_free(cell)) result = point_between(a, b, middle());
    return !result;
  });
  return result;
}

std::vector<CellOnSegment> cells_along(const FreeSpace& free, const Rational3& a, const Rational3& b) {
  std::vector<CellOnSegment> result;
  for_each_part(free, a, b, [&](CellId cell, bool is_point, const auto& /*middle*/) {
    if (!result.empty() && result.back().cell == cell) {
      result.back().is_point = result.back().is_point && is_point;
    } else {
      result.push_back({cell, is_point});
    }
    return true;
  });
  return result;
}

double distance(const Rational3& a, const Rational3& b) {
  return std::hypot(nearest_double(a[0] - b[0]), nearest_double(a[1] - b[1]), nearest_double(a[2] - b[2]));
}

}  // namespace nef::planner
