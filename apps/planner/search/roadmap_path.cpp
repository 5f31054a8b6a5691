// SPDX-License-Identifier: Apache-2.0
//
// A* over the portals of the zones.
#include <algorithm>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/search/a_star.h"
#include "apps/planner/search/search.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

class Search {
 public:
  Search(const FreeSpace& free, const CellFilter& filter, const Rational3& start, const Rational3& goal, bool clearance)
      : free_(free),
        roadmap_(free.roadmap()),
        filter_(filter),
        start_(start),
        goal_(goal),
        near_start_(free.tree().nearest_inside(start)),
        near_goal_(free.tree().nearest_inside(goal)),
        clearance_(clearance),
        search_(roadmap_.portals().size()),
        by_zone_(roadmap_.portals().size(), 0) {}

  std::optional<std::vector<Rational3>> run() {
    const ExactPoint start(near_start_);
    const ExactPoint goal(near_goal_);
    const ZoneId start_zone = roadmap_.zone_at(start);
    goal_zone_ = roadmap_.zone_at(goal);
    goal_approximate_ = to_vector(goal.approximate());
    if (start_zone == goal_zone_) return extract({});
    enter_zone(start_zone, AStar::kNone, to_vector(start.approximate()), 0);
    while (const std::optional<PortalId> portal = search_.next()) {
      const std::span<const ZoneId> around = roadmap_.zones_of(*portal);
      if (std::find(around.begin(), around.end(), goal_zone_) != around.end()) return extract(search_.way_to(*portal));
      for (const ZoneId zone : around) {
        if (filter_(roadmap_.cell_of(zone))) enter_zone(zone, *portal, point_of_portal(*portal), search_.cost(*portal));
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] Vector3d point_of_portal(PortalId portal) const {
    return to_vector(roadmap_.portals()[portal].approximate);
  }

  void enter_zone(ZoneId zone, PortalId from, const Vector3d& from_point, double cost) {
    for (const PortalId next : roadmap_.portals_of(zone)) {
      const CellId cell = roadmap_.portals()[next].cell;
      if (!filter_(cell)) continue;
      // With clearance, touching the boundary of a volume costs extra.
      const bool contact = clearance_ && free_.cells().dimension(cell) < free_.local_dimension(cell);
      const Vector3d there = point_of_portal(next);
      const double length = (there - from_point).norm();
      const double total = cost + (contact ? 4 * length + 1e-3 : length);
      if (!search_.improves(next, total)) continue;
      by_zone_[next] = zone;
      search_.offer(next, from, total, total + (goal_approximate_ - there).norm());
    }
  }

  // The way-points of a chain of portals.
  std::vector<Rational3> extract(const std::vector<PortalId>& chain) {
    std::vector<Rational3> points{start_};
    if (near_start_ != start_) points.push_back(near_start_);
    for (const PortalId portal : chain) append(points, roadmap_.point(portal), by_zone_[portal]);
    append(points, near_goal_, goal_zone_);
    if (near_goal_ != goal_) points.push_back(goal_);
    return points;
  }

  // Both ends lie in the closure of one zone, which is convex. The segment between them may run along its boundary,
  // which need not be free; one through a point inside the zone does not. A zone without portals holds both ends
  // inside.
  void append(std::vector<Rational3>& points, const Rational3& next, ZoneId zone) {
    if (points.back() == next) return;
    const bool may_touch = clearance_ && !roadmap_.portals_of(zone).empty();
    if (may_touch || !segment_allowed(free_, filter_, points.back(), next)) {
      const Rational3 inside = roadmap_.interior_point(zone);
      if (inside != next && inside != points.back()) points.push_back(inside);
    }
    NEF_ASSERT(segment_allowed(free_, filter_, points.back(), next));
    points.push_back(next);
  }

  const FreeSpace& free_;
  const Roadmap& roadmap_;
  const CellFilter& filter_;
  const Rational3& start_;
  const Rational3& goal_;
  Rational3 near_start_;  // start and goal, or where one comes from them to where there are portals
  Rational3 near_goal_;
  bool clearance_;
  AStar search_;
  std::vector<ZoneId> by_zone_;  // through which each portal was reached
  ZoneId goal_zone_ = 0;
  Vector3d goal_approximate_ = Vector3d::Zero();
};

}  // namespace

std::optional<std::vector<Rational3>> roadmap_path(const FreeSpace& free, const CellFilter& filter,
                                                   const Rational3& start, const Rational3& goal, bool clearance,
                                                   const Monitor& monitor) {
  free.build_roadmap(monitor);
  return Search(free, filter, start, goal, clearance).run();
}

}  // namespace nef::planner
