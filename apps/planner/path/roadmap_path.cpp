// SPDX-License-Identifier: Apache-2.0
//
// A* over the stations of the zones.
#include <algorithm>
#include <cmath>
#include <queue>

#include "apps/planner/free_space/vectors.h"
#include "apps/planner/path/path.h"
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
        clearance_(clearance) {}

  std::optional<std::vector<Rational3>> run() {
    const ExactPoint start(near_start_);
    const ExactPoint goal(near_goal_);
    start_zone_ = zones_.zone_at(start);
    goal_zone_ = zones_.zone_at(goal);
    goal_approximate_ = goal.approximate();
    const std::size_t count = zones_.stations().size();
    cost_.assign(count, HUGE_VAL);
    came_from_.assign(count, kStart);
    by_zone_.assign(count, start_zone_);
    settled_.assign(count, false);
    if (start_zone_ == goal_zone_) return extract({});
    enter_zone(start_zone_, kStart, start.approximate(), 0);
    while (!queue_.empty()) {
      const StationId station = queue_.top().second;
      queue_.pop();
      if (settled_[station]) continue;
      settled_[station] = true;
      if (const std::optional<std::vector<StationId>> chain = arrive(station)) return extract(*chain);
      for (const ZoneId zone : zones_.zones_of(station)) {
        if (filter_(zones_.cell_of(zone))) {
          enter_zone(zone, station, zones_.stations()[station].approximate, cost_[station]);
        }
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr StationId kStart = 0xffffffffU;
  using Entry = std::pair<double, StationId>;

  void enter_zone(ZoneId zone, StationId from, const Vector& place, double cost) {
    for (const StationId next : zones_.stations_of(zone)) {
      const Zones::Station& station = zones_.stations()[next];
      if (!filter_(station.cell)) continue;
      // With clearance, touching the boundary of a volume costs extra.
      const bool contact = clearance_ && free_.cells().dimension(station.cell) < free_.local_dimension(station.cell);
      const double length = span(place, station.approximate);
      const double total = cost + (contact ? 4 * length + 1e-3 : length);
      if (!(total < cost_[next])) continue;
      cost_[next] = total;
      came_from_[next] = from;
      by_zone_[next] = zone;
      queue_.emplace(total + span(station.approximate, goal_approximate_), next);
    }
  }

  std::optional<std::vector<StationId>> arrive(StationId station) {
    const std::span<const ZoneId> around = zones_.zones_of(station);
    if (std::find(around.begin(), around.end(), goal_zone_) == around.end()) return std::nullopt;
    std::vector<StationId> chain;
    for (StationId s = station; s != kStart; s = came_from_[s]) chain.push_back(s);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  // The way-points of a chain of stations. Between two points in the closure of one zone the
  // straight segment may run along the boundary; a point inside the zone mends that.
  std::vector<Rational3> extract(const std::vector<StationId>& chain) {
    std::vector<Rational3> points{start_};
    if (near_start_ != start_) points.push_back(near_start_);
    for (const StationId station : chain) append(points, zones_.point(station), by_zone_[station]);
    append(points, near_goal_, goal_zone_);
    if (near_goal_ != goal_) points.push_back(goal_);
    return points;
  }

  void append(std::vector<Rational3>& points, const Rational3& next, ZoneId zone) {
    if (points.back() == next) return;
    if (clearance_) {
      if (zone < free_.tree().leaves().size() && free_.tree().leaves()[zone].dimension == 3) {
        const Rational3 inside = zones_.interior_point(zone);
        if (inside != next && inside != points.back()) points.push_back(inside);
      }
    } else if (!segment_allowed(free_, filter_, points.back(), next)) {
      points.push_back(zones_.interior_point(zone));
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
  ZoneId start_zone_ = 0;
  ZoneId goal_zone_ = 0;
  Vector goal_approximate_{};
  std::vector<double> cost_;
  std::vector<StationId> came_from_;
  std::vector<ZoneId> by_zone_;
  std::vector<bool> settled_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::optional<std::vector<Rational3>> roadmap_path(const FreeSpace& free, const CellFilter& filter,
                                                   const Rational3& start, const Rational3& goal, bool clearance) {
  return Search(free, filter, start, goal, clearance).run();
}

}  // namespace nef::planner
