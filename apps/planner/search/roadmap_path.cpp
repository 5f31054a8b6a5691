// SPDX-License-Identifier: Apache-2.0
//
// A* over the stations of the zones.
#include <algorithm>

#include "apps/planner/free_space/vectors.h"
#include "apps/planner/search/a_star.h"
#include "apps/planner/search/search.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

class Search {
 public:
  Search(const FreeSpace& free, const CellFilter& filter, const Rational3& start, const Rational3& goal, bool clearance)
      : free_(free),
        zones_(free.zones()),
        filter_(filter),
        start_(start),
        goal_(goal),
        near_start_(free.tree().nearest_inside(start)),
        near_goal_(free.tree().nearest_inside(goal)),
        clearance_(clearance),
        search_(zones_.stations().size()),
        by_zone_(zones_.stations().size(), 0) {}

  std::optional<std::vector<Rational3>> run() {
    const ExactPoint start(near_start_);
    const ExactPoint goal(near_goal_);
    const ZoneId start_zone = zones_.zone_at(start);
    goal_zone_ = zones_.zone_at(goal);
    goal_approximate_ = to_vector(goal.approximate());
    if (start_zone == goal_zone_) return extract({});
    enter_zone(start_zone, AStar::kNone, to_vector(start.approximate()), 0);
    while (const std::optional<StationId> station = search_.next()) {
      const std::span<const ZoneId> around = zones_.zones_of(*station);
      if (std::find(around.begin(), around.end(), goal_zone_) != around.end()) return extract(search_.way_to(*station));
      for (const ZoneId zone : around) {
        if (filter_(zones_.cell_of(zone))) enter_zone(zone, *station, place_of(*station), search_.cost(*station));
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] Vector3d place_of(StationId station) const { return to_vector(zones_.stations()[station].approximate); }

  void enter_zone(ZoneId zone, StationId from, const Vector3d& place, double cost) {
    for (const StationId next : zones_.stations_of(zone)) {
      const CellId cell = zones_.stations()[next].cell;
      if (!filter_(cell)) continue;
      // With clearance, touching the boundary of a volume costs extra.
      const bool contact = clearance_ && free_.cells().dimension(cell) < free_.local_dimension(cell);
      const Vector3d there = place_of(next);
      const double length = (there - place).norm();
      const double total = cost + (contact ? 4 * length + 1e-3 : length);
      if (!search_.improves(next, total)) continue;
      by_zone_[next] = zone;
      search_.offer(next, from, total, total + (goal_approximate_ - there).norm());
    }
  }

  // The way-points of a chain of stations.
  std::vector<Rational3> extract(const std::vector<StationId>& chain) {
    std::vector<Rational3> points{start_};
    if (near_start_ != start_) points.push_back(near_start_);
    for (const StationId station : chain) append(points, zones_.point(station), by_zone_[station]);
    append(points, near_goal_, goal_zone_);
    if (near_goal_ != goal_) points.push_back(goal_);
    return points;
  }

  // Both ends lie in the closure of one zone, which is convex. The segment between them may run along its boundary,
  // which need not be free; one through a point inside the zone does not.
  void append(std::vector<Rational3>& points, const Rational3& next, ZoneId zone) {
    if (points.back() == next) return;
    if (clearance_ || !segment_allowed(free_, filter_, points.back(), next)) {
      const Rational3 inside = zones_.interior_point(zone);
      if (inside != next && inside != points.back()) points.push_back(inside);
    }
    NEF_ASSERT(segment_allowed(free_, filter_, points.back(), next));
    points.push_back(next);
  }

  const FreeSpace& free_;
  const Zones& zones_;
  const CellFilter& filter_;
  const Rational3& start_;
  const Rational3& goal_;
  Rational3 near_start_;  // start and goal, or where one comes from them to where there are stations
  Rational3 near_goal_;
  bool clearance_;
  AStar search_;
  std::vector<ZoneId> by_zone_;  // through which each station was reached
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
