// SPDX-License-Identifier: Apache-2.0
//
// Free space of a translating robot [Lozano-Pérez 1983]. What is forbidden is a union of sums, and sums distribute over
// unions, so all pairs of all obstacles go into one union; only what meets the obstacles' union without
// its border needs that union first (it contains seams between touching obstacles). Solid obstacles that are not convex
// may be summed without cells.
#include <algorithm>
#include <iterator>
#include <string>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/decomposition/wall_axis.h"
#include "apps/minkowski/part_of_sum.h"
#include "apps/minkowski/sum/fixed_obstacles.h"
#include "apps/minkowski/sum/pair_sums.h"
#include "apps/minkowski/sum/strategy_choice.h"
#include "nef/base/error.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// The operands whose products make the forbidden set.
struct Forbidden {
  Operand obstacles_open, robot_open;    // full-dimensional obstacles against the inside of the robot
  Operand obstacles_flat, robot_marked;  // obstacles with lower-dimensional parts against it
  Operand obstacles_inner, robot_thin;   // obstacles without borders against the robot's lower-dimensional parts
};

std::vector<Polyhedron> closures(std::span<const Polyhedron> sets, const Monitor& monitor) {
  std::vector<Polyhedron> result;
  for (const Polyhedron& set : sets) result.push_back(closure(set, monitor));
  return result;
}

// What a thin robot must not meet with more than its border: each obstacle without its border, and their union without
// its border, which closes the seams where obstacles touch. (A stick in the rim of a sheet is nothing in the union.)
Polyhedron inner_of(std::span<const Polyhedron> closed, const Monitor& monitor) {
  std::vector<Polyhedron> inner{without_border(unite_all(closed, monitor))};
  for (const Polyhedron& obstacle : closed) {
    if (!is_full_dimensional(obstacle)) inner.push_back(without_border(obstacle));
  }
  return unite_all(inner, monitor);
}

// The lower-dimensional parts of a closed robot without its border.
Polyhedron thin_parts(const Polyhedron& closed, const Monitor& monitor) {
  return subtract(without_border(closed), interior(closed, monitor), monitor);
}

void append(std::vector<ConvexCell>& to, std::vector<ConvexCell> from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// What solid obstacles forbid whose sums with the robot's inside need no cells, and which obstacles these are.
struct WithoutCells {
  std::vector<Polyhedron> sums;
  std::vector<char> is_done;  // per obstacle
  StrategyChoice others;
};

// Sets of few vertices have few cells.
WithoutCells sums_without_cells(const Polyhedron& robot, std::span<const Polyhedron> obstacles,
                                const MinkowskiOptions& options, MinkowskiReport& report) {
  WithoutCells result;
  result.is_done.assign(obstacles.size(), 0);
  result.others.why = "obstacles are convex, have few cells, or are not solid";
  const bool insist = options.strategy == UnionStrategy::kConvolution;
  if (!insist && options.strategy != UnionStrategy::kAuto) return result;
  const Monitor& monitor = options.monitor;
  const Polyhedron robot_inside = interior(negate(robot, monitor), monitor);
  if (robot_inside.is_empty()) return result;
  Summand of_robot(robot_inside);
  const auto parts = static_cast<double>(obstacles.size() + 1);  // the last one: what needs cells
  const std::size_t robot_cells = insist ? 0 : estimated_cells(robot_inside.complex(), monitor);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Polyhedron closed = closure(obstacles[i], monitor);
    if (!is_full_dimensional(closed)) continue;
    const std::size_t vertices = closed.complex().vertex_count() * robot_inside.complex().vertex_count();
    if (!insist && vertices < 4 * kFewPairsOfPieces) continue;
    const std::size_t cells = insist ? 0 : estimated_cells(closed.complex(), monitor);
    if (!insist && (cells < 2 || cells * robot_cells < kFewPairsOfPieces)) continue;
    StrategyChoice choice;
    const PartOfSum part(monitor, static_cast<double>(i) / parts, static_cast<double>(i + 1) / parts);
    Summand of_obstacle(closed);
    std::optional<Polyhedron> sum =
        sum_by_convolution(of_obstacle, of_robot, {options.strategy, part.monitor()}, report, choice).sum;
    if (sum) {
      report.choices.push_back(std::move(choice));
      result.sums.push_back(*std::move(sum));
      result.is_done[i] = 1;
    } else {
      result.others = std::move(choice);
    }
  }
  return result;
}

Forbidden decompose_all(const Polyhedron& robot, std::span<const Polyhedron> obstacles,
                        const std::vector<char>& is_done, const Monitor& monitor) {
  Forbidden result;
  const Polyhedron turned = negate(robot, monitor);
  const Polyhedron robot_inside = interior(turned, monitor);
  if (!robot_inside.is_empty()) {
    std::vector<ConvexCell> solid;
    std::vector<ConvexCell> flat;
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      if (is_done[i] != 0) continue;
      const Polyhedron closed = closure(obstacles[i], monitor);
      if (is_full_dimensional(closed)) {
        append(solid, decompose_open(closed, monitor));
      } else {
        append(flat, decompose(closed, monitor));
      }
    }
    std::stable_sort(flat.begin(), flat.end(),
                     [](const ConvexCell& a, const ConvexCell& b) { return a.dimension > b.dimension; });
    if (!solid.empty()) result.robot_open = Operand(decompose_open(robot_inside, monitor));
    if (!flat.empty()) result.robot_marked = Operand(decompose(robot_inside, monitor));
    result.obstacles_open = Operand(std::move(solid));
    result.obstacles_flat = Operand(std::move(flat));
  }
  if (!is_full_dimensional(turned)) {
    result.obstacles_inner = Operand(decompose(inner_of(closures(obstacles, monitor), monitor), monitor));
    result.robot_thin = Operand(decompose(thin_parts(closure(turned, monitor), monitor), monitor));
  }
  return result;
}

Polyhedron outside_of(const Polyhedron& forbidden, const std::optional<std::array<Rational3, 2>>& box,
                      const Monitor& monitor) {
  return box ? subtract(make_box((*box)[0], (*box)[1], monitor), forbidden, monitor) : complement(forbidden);
}

// The definition, step by step.
Polyhedron forbidden_of_unbounded(const Polyhedron& robot, std::span<const Polyhedron> obstacles,
                                  const MinkowskiOptions& options, MinkowskiReport& report) {
  const Monitor& monitor = options.monitor;
  const std::vector<Polyhedron> closed = closures(obstacles, monitor);
  const Polyhedron turned = closure(negate(robot, monitor), monitor);
  Polyhedron entered = minkowski_sum(unite_all(closed, monitor), interior(turned, monitor), options, &report);
  if (is_full_dimensional(turned)) return entered;
  const Polyhedron inner = inner_of(closed, monitor);
  return unite(entered, minkowski_sum(inner, thin_parts(turned, monitor), options, &report), monitor);
}

}  // namespace

Polyhedron configuration_space(const Polyhedron& robot, std::span<const Polyhedron> obstacles,
                               const std::optional<std::array<Rational3, 2>>& box, const MinkowskiOptions& options,
                               MinkowskiReport* report) {
  MinkowskiReport unused;
  MinkowskiReport& r = report != nullptr ? *report : unused;
  if (robot.is_empty()) throw InputError("the robot is the empty set: it has no reference point to move");
  const auto bounded = [](const Polyhedron& set) { return set.is_bounded(); };
  if (!robot.is_bounded() || !std::all_of(obstacles.begin(), obstacles.end(), bounded)) {
    return outside_of(forbidden_of_unbounded(robot, obstacles, options, r), box, options.monitor);
  }
  const Stopwatch watch;
  WithoutCells without_cells = sums_without_cells(robot, obstacles, options, r);
  Forbidden parts;
  {
    const PhaseTimer phase(r.seconds_decomposition, r.predicates_decomposition, options.monitor);
    parts = decompose_all(robot, obstacles, without_cells.is_done, phase.monitor());
  }
  r.cells_a += parts.obstacles_open.size() + parts.obstacles_flat.size() + parts.obstacles_inner.size();
  r.cells_b += std::max(parts.robot_open.size(), parts.robot_marked.size()) + parts.robot_thin.size();
  const std::array<Product, 3> products = {Product{parts.obstacles_open, parts.robot_open},
                                           Product{parts.obstacles_flat, parts.robot_marked},
                                           Product{parts.obstacles_inner, parts.robot_thin}};
  const bool any =
      std::any_of(products.begin(), products.end(), [](const Product& p) { return p.a.size() * p.b.size() > 0; });
  if (any) {
    const auto before = static_cast<double>(obstacles.size());
    const PartOfSum last(options.monitor, before / (before + 1));
    without_cells.sums.push_back(
        union_of_pair_sums_for(std::move(without_cells.others), products, {options.strategy, last.monitor()}, r));
  }
  Polyhedron free;
  {
    const PhaseTimer phase(r.seconds_union, r.predicates_union, options.monitor);
    free = outside_of(unite_all(without_cells.sums, phase.monitor()), box, phase.monitor());
  }
  r.seconds_total += watch.seconds();
  return free;
}

}  // namespace nef::minkowski
