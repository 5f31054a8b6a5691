// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_search.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <variant>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/path.h"
#include "apps/planner/turning/turning_robot.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/geometry/rational_vectors.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

using Node = std::uint32_t;
constexpr Node kNoNode = 0xffffffffU;

// The free space at one angle. Its components are nodes.
struct Slice {
  std::shared_ptr<const FreeSpace> free;
  Node first_node = 0;
};

// A turn in place that is proved to be free: from a component of one slice to one of another.
struct Bridge {
  Node from = 0, to = 0;
  Turn from_turn, to_turn;
  Rational3 position;                      // of a point in the component of ...
  std::shared_ptr<const FreeSpace> outer;  // ... where the robot may turn
};

// A range of angles with the free space of its inner robot. A robot without an inner one meets nothing: one component.
struct Cell {
  Turn low, high;
  std::vector<std::uint32_t> below;  // component of the inner free space that holds each component of the lower slice
  std::vector<std::uint32_t> above;  // ... of the upper slice
  std::shared_ptr<const FreeSpace> inner;
};

// A component of an inner free space: the index of its cell, and which component.
using Room = std::pair<std::size_t, std::uint32_t>;
using Rooms = std::set<Room>;

Turn middle_of(const Turn& a, const Turn& b) { return (a + b) / 2; }

// The same scene for a solid robot, cut up once rather than for each free space: what is open and meets the inside of
// an obstacle meets the inside of one of its pieces.
Scene with_convex_obstacles(const Scene& scene) {
  Scene result = scene;
  result.obstacles.clear();
  result.obstacle_names.clear();
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const Polyhedron& obstacle = scene.obstacles[i];
    std::vector<Polyhedron> pieces;
    if (obstacle.is_bounded() && obstacle.is_regular()) {
      for (const minkowski::ConvexCell& cell : minkowski::decompose(obstacle)) {
        if (cell.dimension == 3) pieces.push_back(convex_hull(cell.mesh.vertices));
      }
    } else {
      pieces.push_back(obstacle);
    }
    for (Polyhedron& piece : pieces) {
      result.obstacles.push_back(std::move(piece));
      result.obstacle_names.push_back(scene.obstacle_names[i]);
    }
  }
  return result;
}

class TurningSearch {
 public:
  TurningSearch(const Scene& scene, const TurningQuestion& question, const TurningLimits& limits)
      : scene_(with_convex_obstacles(scene)), q_(question), limits_(limits), robot_(scene.robot, question.axis) {}

  TurningAnswer run() {
    const Interruptible interruptible(limits_.stop);
    try {
      return answer();
    } catch (const Interrupted&) {
      // What was in question when the last cells were begun; at first, everything.
      if (answer_.open_ranges.empty()) answer_.open_ranges.push_back({q_.low, q_.high});
      return finished(TurningAnswer::Status::kUndecided);
    }
  }

 private:
  TurningAnswer answer() {
    find_parallel_faces();
    const Node start = node_of(q_.start);
    if (start == kNoNode) return finished(TurningAnswer::Status::kInvalidStart);
    const Node goal = node_of(q_.goal);
    if (goal == kNoNode) return finished(TurningAnswer::Status::kInvalidGoal);
    make_first_cells();
    while (true) {
      if (const auto way = way_over_bridges(start, goal)) {
        answer_.path = path_of(*way);
        return finished(TurningAnswer::Status::kPath);
      }
      const std::variant<std::vector<std::size_t>, Rooms> found = cells_in_question(start, goal);
      if (const Rooms* start_side = std::get_if<Rooms>(&found)) {
        answer_.proof = proof_of(*start_side);
        return finished(TurningAnswer::Status::kInfeasible);
      }
      const auto& questionable = std::get<std::vector<std::size_t>>(found);
      NEF_ASSERT(!questionable.empty());
      answer_.open_ranges.clear();
      for (const std::size_t i : questionable) {
        const Cell& cell = std::next(cells_.begin(), static_cast<std::ptrdiff_t>(i))->second;
        answer_.open_ranges.push_back({cell.low, cell.high});
      }
      if (cells_.size() >= limits_.max_cells) return finished(TurningAnswer::Status::kUndecided);
      for (const TurnRange& range : answer_.open_ranges) split(range);
    }
  }

  TurningAnswer finished(TurningAnswer::Status status) {
    answer_.status = status;
    answer_.cells = cells_.size();
    if (status != TurningAnswer::Status::kUndecided) answer_.open_ranges.clear();
    return std::move(answer_);
  }

  // Where a slice is kept: the ends of a ring are one.
  [[nodiscard]] Turn key(const Turn& turn) const { return q_.is_ring() && turn == q_.high ? q_.low : turn; }

  [[nodiscard]] std::shared_ptr<const FreeSpace> free_space_of(const Polyhedron& robot) const {
    Scene scene = scene_;
    scene.robot = robot;
    // A robot that is nothing is nowhere in the way.
    if (robot.is_empty()) {
      scene.robot = make_point({0, 0, 0});
      scene.obstacles.clear();
      scene.obstacle_names.clear();
    }
    return std::make_shared<const FreeSpace>(free_positions(scene));
  }

  const Slice& slice(const Turn& turn) {
    const auto [place, is_new] = slices_.try_emplace(key(turn));
    if (is_new) {
      place->second.free = free_space_of(robot_.at(turn));
      place->second.first_node = node_count_;
      node_count_ += static_cast<Node>(place->second.free->components().size());
    }
    return place->second;
  }

  Node node_of(const Pose& pose) {
    const Slice& at = slice(pose.turn);
    const CellId cell = at.free->locate(ExactPoint(pose.position));
    return at.free->is_free(cell) ? at.first_node + at.free->component(cell) : kNoNode;
  }

  // A point of each component.
  static std::vector<Rational3> points_of(const FreeSpace& free) {
    std::vector<Rational3> points(free.components().size());
    std::vector<bool> found(points.size(), false);
    // Vertices come first, so that only open components need the roadmap.
    for (CellId cell = 0; cell < free.cells().size(); ++cell) {
      if (!free.is_free(cell) || found[free.component(cell)]) continue;
      found[free.component(cell)] = true;
      Rational3& point = points[free.component(cell)];
      if (free.complex().vertex_count() == 0) continue;  // all of space
      point = free.cells().dimension(cell) == 0 ? free.vertices(cell).front()
                                                : free.zones().interior_point(free.zones().zone_in(cell));
    }
    return points;
  }

  // For each component of one free space the component of a larger one that holds it.
  static std::vector<std::uint32_t> holders(const FreeSpace& small, const FreeSpace& large) {
    std::vector<std::uint32_t> result;
    for (const Rational3& point : points_of(small)) {
      const CellId cell = large.locate(ExactPoint(point));
      NEF_ASSERT(large.is_free(cell));
      result.push_back(large.component(cell));
    }
    return result;
  }

  // Its bridges are there at once.
  Cell cell_between(const Turn& low, const Turn& high) {
    ++answer_.looked_at;
    const Slice lower = slice(low);
    const Slice upper = slice(high);
    const auto outer = free_space_of(robot_.outer(low, high));
    const std::vector<std::uint32_t> at_low = holders(*outer, *lower.free);
    const std::vector<std::uint32_t> at_high = holders(*outer, *upper.free);
    const std::vector<Rational3> points = points_of(*outer);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bridges_.push_back({lower.first_node + at_low[i], upper.first_node + at_high[i], low, high, points[i], outer});
    }
    const auto inner = free_space_of(robot_.inner(low, high));
    return {low, high, holders(*lower.free, *inner), holders(*upper.free, *inner), inner};
  }

  // Quarters, start and goal are breakpoints from the beginning.
  void make_first_cells() {
    std::set<Turn> points{q_.low, q_.high, q_.start.turn, q_.goal.turn};
    for (Integer quarter = ceiling_of(q_.low); Turn(quarter) < q_.high; ++quarter) points.insert(Turn(quarter));
    for (auto next = std::next(points.begin()); next != points.end(); ++next) {
      cells_[*std::prev(next)] = cell_between(*std::prev(next), *next);
    }
  }

  void split(const TurnRange& range) {
    const Turn at = split_point(range);
    const Cell below = cell_between(range.low, at);
    const Cell above = cell_between(at, range.high);
    cells_[range.low] = below;
    cells_[at] = above;
  }

  // An angle of parallel faces inside, the nearest to the middle; else the middle.
  [[nodiscard]] Turn split_point(const TurnRange& range) const {
    const Turn middle = middle_of(range.low, range.high);
    std::optional<Turn> best;
    for (auto at = parallel_.upper_bound(range.low); at != parallel_.end() && *at < range.high; ++at) {
      if (!best || abs(*at - middle) < abs(*best - middle)) best = *at;
    }
    return best.value_or(middle);
  }

  // Turns at which a face of the robot looks against a face of an obstacle, as far as they are rational.
  void find_parallel_faces() {
    std::set<Rational3> of_obstacles;
    for (const Polyhedron& obstacle : scene_.obstacles) {
      const Complex& c = obstacle.complex();
      for (const Facet& facet : c.facets) {
        if (c.planes.infimaximal(facet.plane)) continue;
        Rational3 n;
        for (std::size_t k = 0; k < 3; ++k) {
          n[k] = Rational(mpz_class(mpz_srcptr(c.planes.coefficient(facet.plane, k))));
        }
        of_obstacles.insert(normalized(n));
      }
    }
    std::set<Rational3> of_robot;
    for (const TurningRobot::Piece& piece : robot_.pieces()) {
      for (const TurningRobot::Face& face : piece.faces) of_robot.insert(normalized(face.normal));
    }
    for (const Rational3& n : of_robot) {
      for (const Rational3& m : of_obstacles) {
        // The angle from n to m or its opposite, since facets have two sides; in the range, which may begin anywhere.
        for (const Rational3& to : {m, Rational3{-m[0], -m[1], -m[2]}}) {
          const std::optional<Turn> turn = q_.axis.turn_between(n, to);
          if (!turn) break;
          for (Turn at = *turn + 4 * ceiling_of((q_.low - *turn) / 4); at <= q_.high; at += 4) parallel_.insert(at);
        }
      }
    }
  }

  // Equal for vectors across the axis of one direction, and for those along it.
  [[nodiscard]] Rational3 normalized(const Rational3& v) const {
    const Rational3& axis = q_.axis.direction();
    const Rational along = dot(v, axis) / q_.axis.square();
    Rational3 across;
    Rational size;
    for (std::size_t k = 0; k < 3; ++k) {
      across[k] = v[k] - along * axis[k];
      size = std::max(size, Rational(abs(across[k])));
    }
    if (size == 0) return across;
    for (Rational& x : across) x /= size;
    return across;
  }

  // The bridges of a way from a component to another one; nothing if there is none.
  [[nodiscard]] std::optional<std::vector<Bridge>> way_over_bridges(Node start, Node goal) const {
    std::vector<std::vector<std::uint32_t>> at(node_count_);
    for (std::uint32_t b = 0; b < bridges_.size(); ++b) {
      at[bridges_[b].from].push_back(b);
      at[bridges_[b].to].push_back(b);
    }
    std::vector<std::uint32_t> over(node_count_, kNoNode);
    std::vector<Node> queue{start};
    std::vector<bool> seen(node_count_, false);
    seen[start] = true;
    const auto other_end = [](const Bridge& bridge, Node node) {
      return bridge.from == node ? bridge.to : bridge.from;
    };
    for (std::size_t i = 0; i < queue.size() && !seen[goal]; ++i) {
      for (const std::uint32_t b : at[queue[i]]) {
        const Node next = other_end(bridges_[b], queue[i]);
        if (seen[next]) continue;
        seen[next] = true;
        over[next] = b;
        queue.push_back(next);
      }
    }
    if (!seen[goal]) return std::nullopt;
    std::vector<Bridge> way;
    for (Node node = goal; node != start;) {
      Bridge bridge = bridges_[over[node]];
      if (bridge.to != node) {
        std::swap(bridge.from, bridge.to);
        std::swap(bridge.from_turn, bridge.to_turn);
      }
      way.push_back(bridge);
      node = bridge.from;
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  // A shortest way from start to goal through components of inner free spaces, and of it the cells whose step no
  // bridges grant; or, if there is no way, the components that are joined to the start.
  [[nodiscard]] std::variant<std::vector<std::size_t>, Rooms> cells_in_question(Node start, Node goal) const {
    UnionFind granted(node_count_);
    for (const Bridge& bridge : bridges_) granted.unite(bridge.from, bridge.to);
    std::map<Room, std::vector<Node>> members;
    std::vector<std::vector<Room>> rooms(node_count_);
    std::size_t index = 0;
    for (const auto& [low, cell] : cells_) {
      for (const auto& [turn, holds] : {std::pair(&cell.low, &cell.below), std::pair(&cell.high, &cell.above)}) {
        const Node first = slices_.at(key(*turn)).first_node;
        for (std::uint32_t i = 0; i < holds->size(); ++i) {
          members[{index, (*holds)[i]}].push_back(first + i);
          rooms[first + i].emplace_back(index, (*holds)[i]);
        }
      }
      ++index;
    }
    std::vector<Node> from(node_count_, kNoNode);
    std::vector<std::size_t> through(node_count_, 0);
    std::vector<bool> seen(node_count_, false);
    Rooms entered;
    std::vector<Node> queue{start};
    seen[start] = true;
    for (std::size_t i = 0; i < queue.size() && !seen[goal]; ++i) {
      for (const auto& room : rooms[queue[i]]) {
        if (!entered.insert(room).second) continue;
        for (const Node next : members[room]) {
          if (seen[next]) continue;
          seen[next] = true;
          from[next] = queue[i];
          through[next] = room.first;
          queue.push_back(next);
        }
      }
    }
    if (!seen[goal]) return entered;
    std::vector<std::size_t> result;
    UnionFind find = granted;
    for (Node node = goal; node != start; node = from[node]) {
      if (find.find(node) != find.find(from[node])) result.push_back(through[node]);
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  [[nodiscard]] TurningProof proof_of(const Rooms& start_side) const {
    TurningProof proof;
    auto room = start_side.begin();
    for (const auto& [low, cell] : cells_) {
      proof.breakpoints.push_back(low);
      TurningProof::Cell& entry = proof.cells.emplace_back();
      for (Mesh& piece : robot_.inner_pieces(cell.low, cell.high)) entry.inner.push_back(std::move(piece.vertices));
      const std::vector<Rational3> points = points_of(*cell.inner);
      for (; room != start_side.end() && room->first == proof.cells.size() - 1; ++room) {
        entry.start_side.push_back(points[room->second]);
      }
    }
    proof.breakpoints.push_back(q_.high);
    return proof;
  }

  // Of the vertices of a point's component the one that makes the shortest way from `here` to the goal; else the point.
  [[nodiscard]] Rational3 near_way(const FreeSpace& outer, const Rational3& point, const Rational3& here) const {
    const std::uint32_t component = outer.component(outer.locate(ExactPoint(point)));
    const auto length = [&](const Rational3& x) { return distance(here, x) + distance(x, q_.goal.position); };
    Rational3 best = point;
    double least = length(point);
    for (CellId cell = 0; cell < outer.cells().size() && outer.cells().dimension(cell) == 0; ++cell) {
      if (!outer.is_free(cell) || outer.component(cell) != component) continue;
      const Rational3 vertex = outer.vertices(cell).front();
      if (const double there = length(vertex); there < least) {
        least = there;
        best = vertex;
      }
    }
    return best;
  }

  // Translations between the places where it turns. Every motion is checked here once more.
  std::vector<Pose> path_of(const std::vector<Bridge>& way) {
    std::vector<Pose> path{q_.start};
    Pose here = q_.start;
    Turn full_turns = 0;  // angles go on where the ring is closed
    const auto walk_to = [&](const Rational3& position) {
      const FreeSpace& free = *slice(here.turn - full_turns).free;
      const std::optional<ExactPath> part = find_path(free, here.position, position);
      NEF_ASSERT(part && describe_path(free, part->points));
      for (std::size_t i = 1; i < part->points.size(); ++i) path.push_back({part->points[i], here.turn});
      here.position = position;
    };
    for (const Bridge& bridge : way) {
      full_turns = here.turn - bridge.from_turn;
      walk_to(near_way(*bridge.outer, bridge.position, here.position));
      NEF_ASSERT(contains(bridge.outer->set(), here.position));
      here.turn = bridge.to_turn + full_turns;
      path.push_back(here);
    }
    walk_to(q_.goal.position);
    return path;
  }

  const Scene scene_;
  const TurningQuestion& q_;
  const TurningLimits& limits_;
  TurningRobot robot_;
  std::map<Turn, Slice> slices_;
  Node node_count_ = 0;
  std::vector<Bridge> bridges_;  // those of split cells hold on
  std::map<Turn, Cell> cells_;
  std::set<Turn> parallel_;
  TurningAnswer answer_;
};

}  // namespace

TurningAnswer find_turning_path(const Scene& scene, const TurningQuestion& question, const TurningLimits& limits) {
  for (const Pose* pose : {&question.start, &question.goal}) {
    if (pose->turn < question.low || pose->turn > question.high) {
      throw InputError("start and goal must be turned by angles of the range");
    }
  }
  if (!(question.low < question.high) || question.high - question.low > 4) {
    throw InputError("the range of angles must have an extent, and no more than a full circle");
  }
  return TurningSearch(scene, question, limits).run();
}

}  // namespace nef::planner
