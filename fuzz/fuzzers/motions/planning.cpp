// SPDX-License-Identifier: Apache-2.0
//
// Robots and obstacles of all dimensions on a grid. What collides is counted: cells of the robot and of an obstacle
// that are not on their borders. A breadth-first search over the free cells of positions tells components and
// reachability, and an exact walk along a path what it meets. Paths are asked for with every option, and the box may be
// flat in some directions.
#include <algorithm>
#include <map>
#include <optional>

#include "apps/planner/path/question.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/search/search.h"
#include "fuzz/grid.h"
#include "nef/base/error.h"

namespace nef::fuzz {
namespace {

using planner::ContactRule;

bool odd(int x) { return x % 2 != 0; }
int dimension(const GridCell& c) { return static_cast<int>(std::count_if(c.begin(), c.end(), odd)); }

// The cells whose closure holds c, c itself left out.
std::vector<GridCell> star(const GridCell& c) {
  std::vector<GridCell> result;
  for (int code = 0; code < 27; ++code) {
    const GridCell step{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
    bool beside = code != 13;
    GridCell d = c;
    for (std::size_t k = 0; k < 3; ++k) {
      beside = beside && (step[k] == 0 || !odd(c[k]));
      d[k] += step[k];
    }
    if (beside) result.push_back(d);
  }
  return result;
}

bool is_face(const GridCell& c, const GridCell& of) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (c[k] != of[k] && (odd(c[k]) || std::abs(c[k] - of[k]) != 1)) return false;
  }
  return true;
}

// The rule of docs/planner.md: where all of the set is solid its boundary is border; elsewhere a point is border iff
// the set around it is a ball with the point on its rim, i.e. the link is connected and has no loop.
bool on_border(const GridSet& set, const GridCell& c) {
  std::vector<GridCell> around;
  const std::vector<GridCell> all = star(c);
  for (const GridCell& d : all) {
    if (set.holds(d)) around.push_back(d);
  }
  if (around.size() == all.size()) return false;
  const auto solid = [&](const GridCell& d) {
    if (dimension(d) == 3) return true;
    const std::vector<GridCell> over = star(d);
    return std::any_of(over.begin(), over.end(), [&](const GridCell& e) { return dimension(e) == 3 && set.holds(e); });
  };
  if (solid(c) && std::all_of(around.begin(), around.end(), solid)) return true;
  if (around.empty()) return false;
  int euler = 0;
  for (const GridCell& d : around) euler += odd(dimension(d) - dimension(c)) ? 1 : -1;
  std::vector<GridCell> reached{around.front()};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const GridCell& d : around) {
      const GridCell at = reached[next];
      const bool joined = is_face(d, at) || is_face(at, d);
      if (joined && std::find(reached.begin(), reached.end(), d) == reached.end()) reached.push_back(d);
    }
  }
  return reached.size() == around.size() && euler == 1;
}

GridSet inner(const GridSet& set) {
  GridSet result(set.low(), set.high());
  for (const GridCell& c : set.cells()) result.set(c, !on_border(set, c));
  return result;
}

void add(GridSet& to, const GridSet& from) {
  for (const GridCell& c : from.cells()) to.set(c, true);
}

// The position as a cell is free or not as a whole.
class Positions {
 public:
  Positions(const GridSet& forbidden, const GridCell& low, const GridCell& high)
      : forbidden_(forbidden), low_(low), high_(high) {
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          if (is_free({x, y, z}) && component({x, y, z}) < 0) flood({x, y, z});
        }
      }
    }
  }

  [[nodiscard]] bool is_free(const GridCell& c) const { return !forbidden_.holds(c); }
  [[nodiscard]] int component(const GridCell& c) const {
    const auto at = number_.find(c);
    return at == number_.end() ? -1 : at->second;
  }
  [[nodiscard]] int component_count() const { return count_; }

  /// A forbidden cell on the segment.
  [[nodiscard]] std::optional<GridCell> first_met(const Rational3& a, const Rational3& b) const {
    for (const GridCell& c : forbidden_.cells()) {
      if (meets(c, a, b)) return c;
    }
    return std::nullopt;
  }

 private:
  // The segment has a point in the relatively open cell.
  static bool meets(const GridCell& c, const Rational3& a, const Rational3& b) {
    Rational least = 0;
    Rational most = 1;
    bool least_open = false;
    bool most_open = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational speed = b[k] - a[k];
      const bool interval = odd(c[k]);
      const Rational low = Rational(c[k] - (interval ? 1 : 0)) / 2;
      const Rational high = Rational(c[k] + (interval ? 1 : 0)) / 2;
      if (speed == 0) {
        if (interval ? a[k] <= low || a[k] >= high : a[k] != low) return false;
        continue;
      }
      Rational from = (low - a[k]) / speed;
      Rational to = (high - a[k]) / speed;
      if (from > to) std::swap(from, to);
      if (from > least || (from == least && interval)) least = from, least_open = interval;
      if (to < most || (to == most && interval)) most = to, most_open = interval;
    }
    return least < most || (least == most && !least_open && !most_open);
  }

  void flood(const GridCell& seed) {
    std::vector<GridCell> queue{seed};
    number_[seed] = count_;
    const auto visit = [&](const GridCell& c) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (c[k] < low_[k] || c[k] > high_[k]) return;
      }
      if (is_free(c) && number_.try_emplace(c, count_).second) queue.push_back(c);
    };
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const GridCell c = queue[next];
      for (const GridCell& d : star(c)) visit(d);
      for (int code = 0; code < 27; ++code) {  // its faces
        const GridCell d{c[0] + code / 9 - 1, c[1] + code / 3 % 3 - 1, c[2] + code % 3 - 1};
        if (d != c && is_face(d, c)) visit(d);
      }
    }
    ++count_;
  }

  const GridSet& forbidden_;
  std::map<GridCell, int> number_;
  GridCell low_, high_;
  int count_ = 0;
};

std::string tuple_text(const Rational3& p) {
  return "(" + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) + ")";
}

class PlanningCase {
 public:
  explicit PlanningCase(const Case& the_case) : case_(the_case) {}

  void run() {
    make_scene();
    const GridSet forbidden = forbidden_positions();
    // Everything that can be forbidden, and a layer of free cells around it, or the box.
    low_.fill(forbidden.low() - 1);
    high_.fill(forbidden.high() + 1);
    if (bounded_) {
      low_.fill(2 * (-1));
      high_.fill(2 * 4);
      for (std::size_t k = 0; k < 3; ++k) {
        if (case_.choices().one_in(5)) low_[k] = high_[k] = 2 * case_.choices().between(-1, 4);
      }
      scene_.box = {point_of(low_), point_of(high_)};
      case_.tell("box " + tuple_text(point_of(low_)) + " " + tuple_text(point_of(high_)));
    }
    const Positions truth(forbidden, low_, high_);
    const planner::Problem problem(scene_);
    static_cast<void>(case_.valid(problem.free_space().set(), "the free space"));
    compare(problem.free_space(), truth);
    prove(problem.free_space());
    for (int i = 0; i < 3; ++i) ask(problem, truth);
  }

 private:
  void make_scene() {
    Choices& choices = case_.choices();
    const int width = choices.between(1, 2);
    robot_ = random_grid_set(choices, width, true);
    label_some_sets(choices, *robot_);
    case_.tell("robot " + robot_->text);
    const std::uint32_t count = 1 + choices.below(3);
    for (std::uint32_t i = 0; i < count; ++i) {
      obstacles_.push_back(random_grid_set(choices, 3, true));
      label_some_sets(choices, obstacles_.back());
      case_.tell("obstacle " + obstacles_.back().text);
      scene_.obstacles.push_back(obstacles_.back().set);
      scene_.obstacle_names.push_back("obstacle " + std::to_string(i));
    }
    scene_.robot = robot_->set;
    bounded_ = choices.below(2) == 1;
    if (choices.one_in(4)) scene_.contact = ContactRule::kForbid;
    case_.tell(scene_.contact == ContactRule::kForbid ? "contact forbidden" : "contact allowed");
  }

  [[nodiscard]] GridSet forbidden_positions() const {
    GridSet all(obstacles_.front().cells.low(), obstacles_.front().cells.high());
    GridSet hard = all;
    for (const GridPolyhedron& obstacle : obstacles_) {
      add(all, obstacle.cells);
      add(hard, inner(obstacle.cells));
    }
    if (scene_.contact == ContactRule::kForbid) return GridSet::sum(all, robot_->cells.negated());
    add(hard, inner(all));
    return GridSet::sum(hard, inner(robot_->cells).negated());
  }

  void compare(const planner::FreeSpace& free, const Positions& truth) {
    Case::require(free.components().size() == static_cast<std::size_t>(truth.component_count()),
                  "components: " + std::to_string(free.components().size()) + ", want " +
                      std::to_string(truth.component_count()));
    std::map<int, std::uint32_t> same;
    for (int x = low_[0]; x <= high_[0]; ++x) {
      for (int y = low_[1]; y <= high_[1]; ++y) {
        for (int z = low_[2]; z <= high_[2]; ++z) {
          const GridCell c{x, y, z};
          const planner::CellId cell = free.locate(planner::ExactPoint(point_of(c)));
          Case::require(free.is_free(cell) == truth.is_free(c), "free: position " + tuple_text(point_of(c)) +
                                                                    ", want " + (truth.is_free(c) ? "free" : "taken"));
          if (!truth.is_free(c)) continue;
          const auto [at, added] = same.try_emplace(truth.component(c), free.component(cell));
          Case::require(at->second == free.component(cell), "components: of position " + tuple_text(point_of(c)));
        }
      }
    }
    std::uint64_t positions = 1;
    for (std::size_t k = 0; k < 3; ++k) positions *= static_cast<std::uint64_t>(high_[k] - low_[k]) + 1;
    case_.count("positions", positions);
  }

  // Proofs that passages are tight hold; what is no solid has none, and not every place of a solid has one.
  void prove(const planner::FreeSpace& free) {
    if (free.passages().empty() || scene_.contact == ContactRule::kForbid) return;
    free.build_roadmap();
    std::optional<planner::PathProof> proof;
    try {
      proof = planner::make_tight_proof(scene_, free);
    } catch (const InputError&) {
      return;
    }
    case_.count(proof ? "tight, proved" : "tight, not proved");
    if (!proof) return;
    const std::optional<std::string> complaint = planner::complaint_about(*proof);
    Case::require(!complaint, "a proof of tight passages: " + complaint.value_or(""));
    const planner::PathProof read = planner::parse_proof(planner::proof_text(*proof), "proof");
    Case::require(!planner::complaint_about(read), "a proof of tight passages that was written and read");
  }

  void ask(const planner::Problem& problem, const Positions& truth) {
    Choices& choices = case_.choices();
    const auto random_cell = [&] {
      GridCell c{};
      for (std::size_t k = 0; k < 3; ++k) c[k] = choices.between(low_[k], high_[k]);
      return c;
    };
    const GridCell start = random_cell();
    const GridCell goal = random_cell();
    if (!truth.is_free(start) || !truth.is_free(goal)) return;
    planner::PathOptions options;
    options.thorough = choices.one_in(4);
    options.clearance = choices.one_in(3);
    options.raw = choices.one_in(4);
    options.roomy = choices.one_in(4);
    if (choices.one_in(4)) options.digits = 2;
    if (choices.one_in(8)) options.min_dimension = choices.between(1, 3);
    case_.tell(std::string("options:") + (options.thorough ? " thorough" : "") +
               (options.clearance ? " clearance" : "") + (options.raw ? " raw" : "") + (options.roomy ? " roomy" : "") +
               (options.digits ? " digits" : "") + " dimension " + std::to_string(options.min_dimension));
    const planner::Answer answer = problem.solve(point_of(start), point_of(goal), options);
    const bool reachable = truth.component(start) == truth.component(goal);
    const bool found = answer.status == planner::Answer::Status::kPath;
    // In thicker parts of free space there may be none.
    Case::require(found == reachable || (options.min_dimension > 0 && !found),
                  "reachable: from " + tuple_text(point_of(start)) + " to " + tuple_text(point_of(goal)) + ", want " +
                      (reachable ? "a path" : "none"));
    case_.count(reachable ? "paths" : "proofs");
    if (answer.path) check(answer.path->points, start, goal, truth, "path");
    const planner::FreeSpace fresh(problem.free_space().set());
    const planner::CellFilter filter(fresh);
    if (const auto way = planner::corridor_path(fresh, filter, 0, point_of(start), point_of(goal), {})) {
      check(*way, start, goal, truth, "corridor");
      case_.count("corridors");
    }
  }

  static void check(const std::vector<Rational3>& points, const GridCell& start, const GridCell& goal,
                    const Positions& truth, const std::string& what) {
    Case::require(points.front() == point_of(start) && points.back() == point_of(goal), what + ": wrong ends");
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const std::optional<GridCell> met = truth.first_met(points[i], points[i + 1]);
      Case::require(!met,
                    what + ": from " + tuple_text(points[i]) + " to " + tuple_text(points[i + 1]) + " meets something");
    }
  }

  const Case& case_;
  std::optional<GridPolyhedron> robot_;
  std::vector<GridPolyhedron> obstacles_;
  planner::Scene scene_;
  bool bounded_ = false;
  GridCell low_{};
  GridCell high_{};
};

}  // namespace

void fuzz_planning(const Case& the_case) { PlanningCase(the_case).run(); }

}  // namespace nef::fuzz
