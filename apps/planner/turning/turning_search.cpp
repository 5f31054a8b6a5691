// SPDX-License-Identifier: Apache-2.0
//
// A graph has the components of slices as nodes. Bridges (turns that are proved free) are edges of cost 0; two nodes in
// one component of an inner free space are joined at cost 1, as a turn that may be possible. A search in order of cost
// gives a way with the fewest open steps. No way is a proof; a way without open steps is a path.
// Otherwise open cells get their own inner robot, then their bridges, and are split in the end, at an angle of parallel
// faces if there is one.
#include "apps/planner/turning/turning_search.h"

#include <algorithm>
#include <array>
#include <queue>
#include <set>

#include "apps/planner/path/path.h"
#include "apps/planner/path/simple_points.h"
#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/turning/turning_cells.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/monitor.h"
#include "nef/geometry/vectors.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

// A component of an inner free space: the lower end of its cell, and which component.
using InnerComponent = std::pair<Turn, std::uint32_t>;
using InnerComponents = std::set<InnerComponent>;

// From a node to another one within a cell.
struct Step {
  Turn cell;
  Node from = 0, to = 0;
};

// How a node was come to.
struct Arrival {
  std::array<std::size_t, 3> cost;  // open steps, bridges, and which one was found first
  Node node, from;
  std::optional<Turn> cell;                                                 // of an open step
  std::uint32_t bridge;                                                     // else
  bool operator<(const Arrival& other) const { return other.cost < cost; }  // the queue begins with the largest
};

class TurningSearch {
 public:
  TurningSearch(const Scene& scene, const TurningQuestion& question, const TurningLimits& limits,
                const Monitor& monitor)
      : q_(question),
        limits_(limits),
        monitor_(monitor),
        cells_(scene, question, monitor),
        parallel_(turns_of_parallel_faces(scene, question, monitor)) {}

  TurningAnswer run() {
    try {
      return answer();
    } catch (const Interrupted&) {
      // What was in question when the last cells were begun.
      if (answer_.open_ranges.empty()) answer_.open_ranges.push_back({q_.low, q_.high});
      return finished(TurningAnswer::Status::kUndecided);
    }
  }

 private:
  TurningAnswer answer() {
    const Node start = cells_.node_of(q_.start, monitor_);
    if (start == kNoNode) return finished(TurningAnswer::Status::kInvalidStart);
    const Node goal = cells_.node_of(q_.goal, monitor_);
    if (goal == kNoNode) return finished(TurningAnswer::Status::kInvalidGoal);
    make_first_cells();
    while (true) {
      InnerComponents entered;
      const std::optional<Way> way = best_way(start, goal, entered);
      if (!way) {
        answer_.proof = proof_of(entered);
        return finished(TurningAnswer::Status::kInfeasible);
      }
      if (way->open.empty()) {
        answer_.path = path_of(way->bridges);
        return finished(TurningAnswer::Status::kPath);
      }
      answer_.open_ranges.clear();
      for (const Step& step : way->open) answer_.open_ranges.push_back({step.cell, cells_.cells().at(step.cell).high});
      if (!refine(way->open)) return finished(TurningAnswer::Status::kUndecided);
    }
  }

  // Does what is most likely to decide about steps of a way. False if there is nothing left to do.
  bool refine(const std::vector<Step>& steps) {
    // One that cannot be done ends the way.
    for (const Step& step : steps) {
      const AngleCell& cell = cells_.cells().at(step.cell);
      if (cell.has_own_inner || cells_.surely_meet(step.from, step.to)) continue;
      cells_.find_inner(step.cell, monitor_);
      return true;
    }
    bool any = false;
    for (const Step& step : steps) {
      if (cells_.cells().at(step.cell).has_bridges) continue;
      cells_.find_bridges(step.cell, monitor_);
      any = true;
    }
    if (any) return true;
    if (cells_.cells().size() >= limits_.max_cells) return false;
    for (const TurnRange& range : answer_.open_ranges) cells_.split(range.low, split_point(range), monitor_);
    return true;
  }

  TurningAnswer finished(TurningAnswer::Status status) {
    answer_.status = status;
    answer_.cells = cells_.cells().size();
    answer_.looked_at = cells_.looked_at();
    if (status != TurningAnswer::Status::kUndecided) answer_.open_ranges.clear();
    return std::move(answer_);
  }

  // Quarters, start and goal are breakpoints from the beginning.
  void make_first_cells() {
    std::set<Turn> points{q_.low, q_.high, q_.start.turn, q_.goal.turn};
    for (Integer quarter = ceiling_of(q_.low); Turn(quarter) < q_.high; ++quarter) points.insert(Turn(quarter));
    for (auto next = std::next(points.begin()); next != points.end(); ++next) {
      cells_.add(*std::prev(next), *next, monitor_);
    }
  }

  // An angle of parallel faces inside, the nearest to the middle; else the middle.
  [[nodiscard]] Turn split_point(const TurnRange& range) const {
    const Turn middle = (range.low + range.high) / 2;
    std::optional<Turn> best;
    for (auto at = parallel_.upper_bound(range.low); at != parallel_.end() && *at < range.high; ++at) {
      if (!best || abs(*at - middle) < abs(*best - middle)) best = *at;
    }
    return best.value_or(middle);
  }

  // A way through components of inner free spaces, and over bridges.
  struct Way {
    std::vector<Step> open;       // steps that no bridges grant, by their cells
    std::vector<Bridge> bridges;  // in the direction of the way
  };

  // A way from start to goal with as few open steps as can be, and of those one with the fewest bridges; or nothing,
  // and then `entered` are the components that are joined to the start.
  [[nodiscard]] std::optional<Way> best_way(Node start, Node goal, InnerComponents& entered) {
    const std::vector<Bridge>& bridges = cells_.bridges();
    std::vector<std::vector<std::uint32_t>> bridges_at(cells_.node_count());
    for (std::uint32_t b = 0; b < bridges.size(); ++b) {
      bridges_at[bridges[b].from].push_back(b);
      bridges_at[bridges[b].to].push_back(b);
    }
    std::map<InnerComponent, std::vector<Node>> members;
    std::vector<std::vector<InnerComponent>> inner(cells_.node_count());
    for (const auto& [low, cell] : cells_.cells()) {
      for (const auto& [turn, holds] : {std::pair(&cell.low, &cell.below), std::pair(&cell.high, &cell.above)}) {
        const Node first = cells_.first_node(*turn, monitor_);
        for (std::uint32_t i = 0; i < holds->size(); ++i) {
          members[{low, (*holds)[i]}].push_back(first + i);
          inner[first + i].emplace_back(low, (*holds)[i]);
        }
      }
    }
    std::vector<std::optional<Arrival>> arrived(cells_.node_count());
    std::priority_queue<Arrival> queue;
    std::size_t found = 0;
    queue.push({{0, 0, 0}, start, start, {}, 0});
    while (!queue.empty() && !arrived[goal]) {
      const Arrival at = queue.top();
      queue.pop();
      if (arrived[at.node]) continue;
      arrived[at.node] = at;
      for (const std::uint32_t b : bridges_at[at.node]) {
        const Node next = bridges[b].from == at.node ? bridges[b].to : bridges[b].from;
        if (!arrived[next]) queue.push({{at.cost[0], at.cost[1] + 1, ++found}, next, at.node, {}, b});
      }
      for (const InnerComponent& component : inner[at.node]) {
        if (!entered.insert(component).second) continue;
        for (const Node next : members[component]) {
          if (!arrived[next]) queue.push({{at.cost[0] + 1, at.cost[1], ++found}, next, at.node, component.first, 0});
        }
      }
    }
    if (!arrived[goal]) return std::nullopt;
    return way_of(arrived, start, goal);
  }

  [[nodiscard]] Way way_of(const std::vector<std::optional<Arrival>>& arrived, Node start, Node goal) const {
    Way way;
    std::map<Turn, Step> open;
    for (Node node = goal; node != start; node = arrived[node]->from) {
      const Arrival& at = *arrived[node];
      if (at.cell) {
        open[*at.cell] = {*at.cell, at.from, node};
        continue;
      }
      Bridge& bridge = way.bridges.emplace_back(cells_.bridges()[at.bridge]);
      if (bridge.to == node) continue;
      std::swap(bridge.from, bridge.to);
      std::swap(bridge.from_turn, bridge.to_turn);
    }
    for (const auto& [cell, step] : open) way.open.push_back(step);
    std::reverse(way.bridges.begin(), way.bridges.end());
    return way;
  }

  [[nodiscard]] TurningProof proof_of(const InnerComponents& start_side) const {
    TurningProof proof;
    auto component = start_side.begin();
    for (const auto& [low, cell] : cells_.cells()) {
      proof.breakpoints.push_back(low);
      TurningProof::Cell& entry = proof.cells.emplace_back();
      if (cell.inner_low != cell.inner_high) {
        for (Mesh& piece : cells_.robot().inner_pieces(cell.inner_low, cell.inner_high)) {
          entry.inner.push_back(std::move(piece.vertices));
        }
      }
      const std::vector<Rational3> points = points_of_components(*cell.inner, monitor_);
      for (; component != start_side.end() && component->first == low; ++component)
        entry.start_side.push_back(points[component->second]);
    }
    proof.breakpoints.push_back(q_.high);
    return proof;
  }

  // Where to turn in the bridge's component of its outer free space: here, or at the goal, or at the vertex that makes
  // the shortest way from here to the goal.
  [[nodiscard]] Rational3 turning_place(const Bridge& bridge, const Rational3& here) const {
    const FreeSpace& outer = *bridge.outer;
    const auto component_at = [&](const Rational3& point) -> std::optional<std::uint32_t> {
      const CellId cell = outer.locate(ExactPoint(point));
      if (!outer.is_free(cell)) return std::nullopt;
      return outer.component(cell);
    };
    const std::optional<std::uint32_t> component = component_at(bridge.position);
    for (const Rational3& simple : {here, q_.goal.position}) {
      if (component_at(simple) == component) return simple;
    }
    const auto length = [&](const Rational3& x) { return distance(here, x) + distance(x, q_.goal.position); };
    Rational3 best = bridge.position;
    double least = length(best);
    for (CellId cell = 0; cell < outer.cells().size() && outer.cells().dimension(cell) == 0; ++cell) {
      if (!outer.is_free(cell) || outer.component(cell) != component) continue;
      const Rational3 vertex = outer.vertices(cell).front();
      if (const double there = length(vertex); there < least) {
        least = there;
        best = vertex;
      }
    }
    if (!limits_.digits || is_rounded(best, *limits_.digits)) return best;
    for (const Rational3& point : rounded_points(best, *limits_.digits)) {
      if (component_at(point) == component) return point;
    }
    return best;
  }

  // Translations between the places where it turns. Every motion is checked here once more.
  std::vector<Pose> path_of(const std::vector<Bridge>& way) {
    std::vector<Pose> path{q_.start};
    Pose here = q_.start;
    Turn full_turns = 0;  // angles go on where the ring is closed
    PathOptions options;
    options.digits = limits_.digits;
    const auto walk_to = [&](const Rational3& position) {
      const FreeSpace& free = cells_.slice(here.turn - full_turns, monitor_);
      const std::optional<ExactPath> part = find_path(free, here.position, position, options, monitor_);
      NEF_ASSERT(part && describe_path(free, part->points));
      for (std::size_t i = 1; i < part->points.size(); ++i) path.push_back({part->points[i], here.turn});
      here.position = position;
    };
    for (const Bridge& bridge : way) {
      full_turns = here.turn - bridge.from_turn;
      walk_to(turning_place(bridge, here.position));
      NEF_ASSERT(contains(bridge.outer->set(), here.position));
      here.turn = bridge.to_turn + full_turns;
      path.push_back(here);
    }
    walk_to(q_.goal.position);
    for (std::size_t i = 1; limits_.digits && i + 1 < path.size(); ++i) {
      const bool is_end = path[i].position == q_.start.position || path[i].position == q_.goal.position;
      if (!is_end && !is_rounded(path[i].position, *limits_.digits)) answer_.unrounded.push_back(i);
    }
    return path;
  }

  const TurningQuestion& q_;
  const TurningLimits& limits_;
  Monitor monitor_;
  TurningCells cells_;
  std::set<Turn> parallel_;
  TurningAnswer answer_;
};

}  // namespace

std::optional<TurningAnswer> invalid_turning_end(const Scene& scene, const TurningQuestion& question,
                                                 const Monitor& monitor) {
  turning_robot(scene.robot);
  for (const auto& [pose, status] : {std::pair(&question.start, TurningAnswer::Status::kInvalidStart),
                                     std::pair(&question.goal, TurningAnswer::Status::kInvalidGoal)}) {
    const RigidPose at{pose->position, question.axis.quaternion(pose->turn)};
    std::optional<Collision> collision = find_collision(scene, at, monitor);
    if (!collision) continue;
    TurningAnswer answer;
    answer.status = status;
    answer.collision = std::move(collision);
    return answer;
  }
  return std::nullopt;
}

TurningAnswer find_turning_path(const Scene& scene, const TurningQuestion& question, const TurningLimits& limits,
                                const Monitor& monitor) {
  for (const Pose* pose : {&question.start, &question.goal}) {
    if (pose->turn < question.low || pose->turn > question.high) {
      throw InputError("the angles of start and goal must lie in the range");
    }
  }
  if (!(question.low < question.high)) throw InputError("the range of angles must have an extent");
  try {
    if (const std::optional<TurningAnswer> invalid = invalid_turning_end(scene, question, monitor)) return *invalid;
    return TurningSearch(scene, question, limits, monitor).run();
  } catch (const Interrupted&) {
    TurningAnswer answer;
    answer.open_ranges.push_back({question.low, question.high});
    return answer;
  }
}

}  // namespace nef::planner
