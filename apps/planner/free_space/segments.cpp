// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/segments.h"

#include <cmath>

#include "apps/planner/free_space/direct_walk.h"
#include "apps/planner/partition/segment_walk.h"

namespace nef::planner {

CellFilter::CellFilter(const FreeSpace& free) : allowed_(free.cells().size()) {
  for (CellId cell = 0; cell < allowed_.size(); ++cell) allowed_[cell] = free.is_free(cell);
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

std::optional<Rational3> first_blocked_position(const FreeSpace& free, const Rational3& a, const Rational3& b) {
  const ExactPoint pa(a);
  const ExactPoint pb(b);
  if (a == b) return free.is_free(pa) ? std::nullopt : std::optional<Rational3>(a);
  std::optional<Rational3> result;
  if (!free.has_roadmap()) {
    walk_directly(free, a, b, [&](const DirectPart& part) {
      if (free.is_free(part.cell)) return true;
      result = point_between(a, b, (part.begin + part.end) / 2);
      return false;
    });
    return result;
  }
  const ExactSegment segment(free.tree().planes(), pa, pb);
  walk_segment(free.tree(), pa, pb, [&](const SegmentPart& part) {
    if (free.is_free(part.cell)) return true;
    result = segment.point((segment.exact(part.begin) + segment.exact(part.end)) / 2);
    return false;
  });
  return result;
}

std::vector<CellOnSegment> cells_along(const FreeSpace& free, const Rational3& a, const Rational3& b) {
  std::vector<CellOnSegment> result;
  const ExactPoint pa(a);
  const ExactPoint pb(b);
  if (a == b) return {{free.locate(pa), true}};
  const auto add = [&](const auto& part) {
    if (!result.empty() && result.back().cell == part.cell) {
      result.back().is_point = result.back().is_point && part.is_point;
    } else {
      result.push_back({part.cell, part.is_point});
    }
    return true;
  };
  if (free.has_roadmap()) {
    walk_segment(free.tree(), pa, pb, add);
  } else {
    walk_directly(free, a, b, add);
  }
  return result;
}

double distance(const Rational3& a, const Rational3& b) {
  return std::hypot(nearest_double(a[0] - b[0]), nearest_double(a[1] - b[1]), nearest_double(a[2] - b[2]));
}

}  // namespace nef::planner
