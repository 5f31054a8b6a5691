// SPDX-License-Identifier: Apache-2.0
//
// A* over cubes of which those that the boundary enters are dear, in the way of [Bohlin, Kavraki 2000]: what a way
// through such cubes is worth is found out when one is wanted. There free space is cut out, and its roadmap tells.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "apps/planner/first_way/first_way.h"
#include "apps/planner/first_way/grid_steps.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

using Cube = EmptyGrid::Cube;
using Points = std::vector<Rational3>;

constexpr double kNarrow = 4;             // how much dearer a step into an entered cube is
constexpr int kCuts = 8;                  // so many are tried in vain
constexpr std::size_t kSmallPart = 1000;  // a roadmap of more cells than so many, or an eighth of all, is not made
constexpr std::uint32_t kMargin = 2;      // cubes around those that a cut is for

// The empty cubes by rooms: those joined by steps to the six neighbours that share a face.
class Rooms {
 public:
  static constexpr std::uint32_t kNoRoom = 0;

  explicit Rooms(const EmptyGrid& grid) : room_(grid.size(), kNoRoom), sizes_{0} {
    const std::array<std::uint32_t, 3> strides{1, grid.counts()[0], grid.counts()[0] * grid.counts()[1]};
    std::vector<std::uint32_t> stack;
    const auto enter = [&](std::uint32_t cube) {
      if (!grid.is_empty(cube) || room_[cube] != kNoRoom) return;
      room_[cube] = static_cast<std::uint32_t>(sizes_.size() - 1);
      ++sizes_.back();
      stack.push_back(cube);
    };
    for (std::uint32_t seed = 0; seed < grid.size(); ++seed) {
      if (!grid.is_empty(seed) || room_[seed] != kNoRoom) continue;
      sizes_.push_back(0);
      enter(seed);
      while (!stack.empty()) {
        const std::uint32_t cube = stack.back();
        stack.pop_back();
        for (const std::uint32_t stride : strides) {
          enter(cube - stride);
          enter(cube + stride);
        }
      }
    }
  }
  [[nodiscard]] std::uint32_t of(std::uint32_t cube) const { return room_[cube]; }
  [[nodiscard]] std::size_t cubes(std::uint32_t room) const { return sizes_[room]; }
  [[nodiscard]] std::size_t size() const { return sizes_.size(); }

 private:
  std::vector<std::uint32_t> room_;
  std::vector<std::size_t> sizes_;
};

class NarrowWay {
 public:
  NarrowWay(const FreeSpace& free, const CellFilter& filter, int min_dimension, const Rational3& start,
            const Rational3& goal, const Monitor& monitor)
      : free_(free),
        filter_(filter),
        min_dimension_(min_dimension),
        monitor_(monitor),
        grid_(free.grid(monitor)),
        rooms_(grid_),
        is_allowed_(rooms_.size(), kUnknown),
        is_closed_(grid_.size(), false),
        steps_(grid_steps(grid_)),
        from_(end_at(start)),
        to_(end_at(goal)) {
    close_rim();
  }

  // From the end in the smaller room, so that little is looked at in vain. Where only tight passages and places where
  // volumes touch can join the two, cubes near these come first.
  std::optional<Points> run() {
    const bool backwards = to_.cubes_around < from_.cubes_around;
    if (backwards) std::swap(from_, to_);
    std::optional<Points> points;
    if (!share_a_volume()) {
      const std::vector<bool> rim = is_closed_;
      close_all_but_passages();
      points = try_cuts();
      is_closed_ = rim;
    }
    if (!points) points = try_cuts();
    if (points && backwards) std::reverse(points->begin(), points->end());
    return points;
  }

 private:
  struct End {
    Rational3 point;
    AStar::Node own = 0;               // the cube that it is in
    std::vector<AStar::Node> portals;  // empty ones that it sees
    std::size_t cubes_around = 0;      // in the rooms of these
  };
  enum : std::int8_t { kUnknown, kNo, kYes };

  void close_rim() {
    for (std::uint32_t i = 0; i < grid_.size(); ++i) {
      const Cube at = grid_.cube(i);
      for (std::size_t k = 0; k < 3; ++k) {
        if (at[k] == 0 || at[k] + 1 == grid_.counts()[k]) is_closed_[i] = true;
      }
    }
  }

  // True if there is a volume that both ends are in or in contact with.
  [[nodiscard]] bool share_a_volume() const {
    const auto volumes = [this](const Rational3& point) {
      const CellId cell = free_.locate(ExactPoint(point));
      std::vector<CellId> result;
      if (free_.cells().dimension(cell) == 3) result.push_back(cell);
      for (const CellId other : free_.neighbours(cell)) {
        if (free_.cells().dimension(cell) < 3 && free_.cells().dimension(other) == 3) result.push_back(other);
      }
      return result;
    };
    const std::vector<CellId> at_goal = volumes(to_.point);
    const std::vector<CellId> at_start = volumes(from_.point);
    return std::find_first_of(at_start.begin(), at_start.end(), at_goal.begin(), at_goal.end()) != at_start.end();
  }

  // Closes all entered cubes but those around tight passages, places where volumes touch, and ends that see no portal.
  void close_all_but_passages() {
    std::vector<bool> is_open(grid_.size(), false);
    const auto open = [&](const Cube& low, const Cube& high) {
      for (std::uint32_t z = low[2] - 1; z <= high[2] + 1; ++z) {
        for (std::uint32_t y = low[1] - 1; y <= high[1] + 1; ++y) {
          for (std::uint32_t x = low[0] - 1; x <= high[0] + 1; ++x) is_open[grid_.index({x, y, z})] = true;
        }
      }
    };
    const auto open_around = [&](CellId cell) {
      Vector3d low = Vector3d::Constant(HUGE_VAL);
      Vector3d high = Vector3d::Constant(-HUGE_VAL);
      for (const Rational3& vertex : free_.vertices(cell)) {
        low = low.cwiseMin(to_vector(vertex));
        high = high.cwiseMax(to_vector(vertex));
      }
      open(grid_.nearest(low), grid_.nearest(high));
    };
    for (const TightPassage& passage : free_.passages())
      std::for_each(passage.cells.begin(), passage.cells.end(), open_around);
    for (const TouchingRooms& place : free_.touching_rooms())
      std::for_each(place.cells.begin(), place.cells.end(), open_around);
    for (const End* end : {&from_, &to_}) {
      if (!end->portals.empty()) continue;
      for_each_around(grid_, grid_.cube(end->own), 2, [&](const Cube& cube) { is_open[grid_.index(cube)] = true; });
    }
    for (std::uint32_t i = 0; i < grid_.size(); ++i) {
      if (!is_open[i] && !grid_.is_empty(i)) is_closed_[i] = true;
    }
  }

  std::optional<Points> try_cuts() {
    for (int cut = 0; cut < kCuts; ++cut) {
      const std::vector<AStar::Node> way = search();
      if (way.empty()) break;
      if (std::optional<Points> points = points_along(way)) return points;
    }
    return std::nullopt;
  }

  [[nodiscard]] End end_at(const Rational3& point) const {
    End end{point, grid_.index(grid_.nearest(to_vector(point))), {}, 0};
    for (const Cube& cube : portals(free_, filter_, point)) {
      end.portals.push_back(grid_.index(cube));
      end.cubes_around = std::max(end.cubes_around, rooms_.cubes(rooms_.of(end.portals.back())));
    }
    return end;
  }

  // True if the room of an empty cube is in a volume that may be used.
  bool is_allowed(AStar::Node cube) {
    std::int8_t& known = is_allowed_[rooms_.of(cube)];
    if (known == kUnknown) {
      known = filter_(free_.locate(ExactPoint(exact_centre(grid_, grid_.cube(cube))))) ? kYes : kNo;
    }
    return known == kYes;
  }

  // True where the way may end: in the room of a portal of the other end, or in its cube if it has none.
  [[nodiscard]] bool is_goal(AStar::Node cube) const {
    if (to_.portals.empty()) return cube == to_.own;
    return grid_.is_empty(cube) && std::any_of(to_.portals.begin(), to_.portals.end(), [&](AStar::Node portal) {
             return rooms_.of(portal) == rooms_.of(cube);
           });
  }

  // The cubes of a way; none if there is none.
  std::vector<AStar::Node> search() {
    AStar search(grid_.size());
    const Cube goal = grid_.cube(to_.own);
    const auto offer = [&](AStar::Node node, AStar::Node before, double cost) {
      search.offer(node, before, cost, cost + steps_between(grid_.cube(node), goal));
    };
    for (const AStar::Node portal : from_.portals) offer(portal, AStar::kNone, 0);
    if (from_.portals.empty()) offer(from_.own, AStar::kNone, 0);
    while (const std::optional<AStar::Node> node = search.next()) {
      monitor_.check_interruption();
      if (is_goal(*node)) return search.way_to(*node);
      for (const GridStep& step : steps_) {
        const AStar::Node next = *node + step.offset;
        if (is_closed_[next]) continue;
        const bool entered = !grid_.is_empty(next);
        const double cost = search.cost(*node) + (entered ? kNarrow : 1) * step.length;
        if (search.improves(next, cost) && (entered || is_allowed(next))) offer(next, *node, cost);
      }
    }
    return {};
  }

  // The points of a way over these cubes. If there is none through entered cubes in a row, these are closed.
  std::optional<Points> points_along(const std::vector<AStar::Node>& way) {
    Points points{from_.point};
    for (std::size_t i = 0; i < way.size();) {
      if (grid_.is_empty(way[i])) {
        points.push_back(exact_centre(grid_, grid_.cube(way[i++])));
        continue;
      }
      std::size_t next = i;
      while (next < way.size() && !grid_.is_empty(way[next])) ++next;
      const std::span<const AStar::Node> entered{way.data() + i, next - i};
      const Rational3 beyond = next < way.size() ? exact_centre(grid_, grid_.cube(way[next])) : to_.point;
      const std::optional<Points> through = way_through(entered, points.back(), beyond);
      if (!through) {
        for (const AStar::Node cube : entered) is_closed_[cube] = true;
        return std::nullopt;
      }
      points.insert(points.end(), through->begin() + 1, through->end());
      i = std::max(next, i + 1);
    }
    if (points.back() == to_.point) return points;
    const std::optional<Points> rest = wide_way(free_, filter_, points.back(), to_.point, monitor_);
    if (!rest) return std::nullopt;
    points.insert(points.end(), rest->begin() + 1, rest->end());
    return points;
  }

  // A way between two points next to some cubes, through what is free around these.
  [[nodiscard]] std::optional<Points> way_through(std::span<const AStar::Node> cubes, const Rational3& a,
                                                  const Rational3& b) const {
    const std::array<Rational3, 2> box = box_around(cubes, a, b);
    const FreeSpace part(intersect(free_.set(), make_box(box[0], box[1], monitor_), 1, monitor_));
    if (part.cells().size() > std::max(kSmallPart, free_.cells().size() / 8)) return std::nullopt;
    CellFilter filter(part);
    for (CellId cell = 0; cell < part.cells().size(); ++cell) {
      if (part.is_free(cell) && part.local_dimension(cell) < min_dimension_) filter.forbid(cell);
    }
    const CellId from = part.locate(ExactPoint(a));
    const CellId to = part.locate(ExactPoint(b));
    if (!filter(from) || !filter(to) || part.component(from) != part.component(to)) return std::nullopt;
    std::optional<Points> points = roadmap_path(part, filter, a, b, false, monitor_);
    for (std::size_t i = 0; points && i + 1 < points->size(); ++i) {
      if (!segment_allowed(free_, filter_, (*points)[i], (*points)[i + 1])) return std::nullopt;
    }
    return points;
  }

  [[nodiscard]] std::array<Rational3, 2> box_around(std::span<const AStar::Node> cubes, const Rational3& a,
                                                    const Rational3& b) const {
    std::array<Rational3, 2> box{a, a};
    const auto add = [&](const Rational3& x) {
      for (std::size_t k = 0; k < 3; ++k) {
        box[0][k] = std::min(box[0][k], x[k]);
        box[1][k] = std::max(box[1][k], x[k]);
      }
    };
    add(b);
    for (const AStar::Node cube : cubes) add(exact_centre(grid_, grid_.cube(cube)));
    const Rational margin = exact_rational(grid_.side()) * (2 * kMargin + 1) / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] -= margin;
      box[1][k] += margin;
    }
    return box;
  }

  const FreeSpace& free_;
  const CellFilter& filter_;
  int min_dimension_;
  Monitor monitor_;
  const EmptyGrid& grid_;
  Rooms rooms_;
  std::vector<std::int8_t> is_allowed_;  // of each room
  std::vector<bool> is_closed_;          // cubes that are not to be used: the rim, and those of cuts in vain
  std::vector<GridStep> steps_;
  End from_;
  End to_;
};

}  // namespace

std::optional<std::vector<Rational3>> narrow_way(const FreeSpace& free, const CellFilter& filter, int min_dimension,
                                                 const Rational3& start, const Rational3& goal,
                                                 const Monitor& monitor) {
  if (free.grid(monitor).size() == 0) return std::nullopt;
  return NarrowWay(free, filter, min_dimension, start, goal, monitor).run();
}

}  // namespace nef::planner
