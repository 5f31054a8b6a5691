// SPDX-License-Identifier: Apache-2.0
//
// Sums of two sets. For relatively open convex cells c of S and d
// of T, S + T is the union of relint(cl c + cl d), whatever the marks. Cells of the decomposition
// carry the marks of their boundary, so for closed regular operands only the solids are left.
//
// If one operand is open and both lie in the closure of their interiors, the open solids suffice:
// for x = s + t with a ball about t in the open set, s moves a little, by a generic vector, into the inside of a
// solid of S, and t moves against it into the inside of a solid of T. By the same argument a point, segment or
// facet that is missing inside may be filled in: solids on both sides of a missing facet may be merged.
#include <optional>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/sum/cobounded_sum.h"
#include "apps/minkowski/sum/pair_sums.h"
#include "apps/minkowski/sum/strategy_choice.h"
#include "apps/minkowski/sum/unbounded_sum.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::minkowski {
namespace {

Polyhedron moved_by_point(const Polyhedron& a, const Polyhedron& point, const Monitor& monitor) {
  return transform(a, AffineMap::translate(point.complex().points.rational(PointId(0U))), monitor);
}

// Sums that need no decomposition.
std::optional<Polyhedron> simple_sum(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  if (a.is_empty() || b.is_empty()) return Polyhedron();
  if (is_point(b)) return moved_by_point(a, b, monitor);
  if (is_point(a)) return moved_by_point(b, a, monitor);
  if (a.is_everything() || b.is_everything()) return Polyhedron::everything();
  return std::nullopt;
}

struct Operands {
  Operand a, b;
};

Operands decompose_both(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                        MinkowskiReport& report) {
  const PhaseTimer phase(report.seconds_decomposition, report.predicates_decomposition, options.monitor);
  const bool only_open = (a.is_open() || b.is_open()) && is_full_dimensional(a) && is_full_dimensional(b);
  Operands result;
  parallel_for(2, phase.monitor(), [&](std::size_t k, const Monitor& own) {
    const Polyhedron& operand = k == 0 ? a : b;
    (k == 0 ? result.a : result.b) = Operand(only_open ? decompose_open(operand, own) : decompose(operand, own));
  });
  report.cells_a += result.a.size();
  report.cells_b += result.b.size();
  return result;
}

Polyhedron bounded_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                       MinkowskiReport& report) {
  if (std::optional<Polyhedron> sum = flat_sum_by_convolution(a, b, options, report)) return *std::move(sum);
  Summand of_a(a);
  Summand of_b(b);
  StrategyChoice choice;
  const auto told = [&](std::optional<Polyhedron>&& sum) {
    report.choices.push_back(std::move(choice));
    return *std::move(sum);
  };
  TriedConvolution tried = sum_by_convolution(of_a, of_b, options, report, choice);
  if (tried.sum) return told(std::move(tried.sum));
  const Operands cells = decompose_both(a, b, options, report);
  if (tried.is_put_off) {
    const std::size_t pairs = cells.a.size() * cells.b.size();
    std::optional<Polyhedron> sum = sum_by_convolution_after_all(of_a, of_b, pairs, options, report, choice);
    if (sum) return told(std::move(sum));
  }
  const Product product{cells.a, cells.b};
  return union_of_pair_sums_for(std::move(choice), {&product, 1}, options, report);
}

// With an unbounded set, a set of bounded complement sums to everything: the former never fits into a hole of the
// latter.
Polyhedron cobounded_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                         MinkowskiReport& report) {
  if (!b.is_bounded()) {
    report.choices.push_back({"none", "one operand is unbounded and does not fit into the other's complement"});
    return Polyhedron::everything();
  }
  const NearHoles near = near_holes(a, b, options.monitor);
  Polyhedron sum = bounded_sum(near.part, b, options, report);
  report.choices.back().why += "; within a box around the bounded complement of an operand";
  return unite(sum, near.beyond, options.monitor);
}

Polyhedron any_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options, MinkowskiReport& report) {
  if (std::optional<Polyhedron> sum = simple_sum(a, b, options.monitor)) {
    report.choices.push_back({"none", "an operand is empty, a single point, or everything"});
    return *std::move(sum);
  }
  if (a.is_bounded() && b.is_bounded()) return bounded_sum(a, b, options, report);
  if (is_cobounded(a)) return cobounded_sum(a, b, options, report);
  if (is_cobounded(b)) return cobounded_sum(b, a, options, report);
  report.choices.push_back({"planes", "an operand and its complement are unbounded"});
  return unbounded_sum(a, b, options, report);
}

}  // namespace

Polyhedron minkowski_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                         MinkowskiReport* report) {
  MinkowskiReport unused;
  MinkowskiReport& r = report != nullptr ? *report : unused;
  const Stopwatch watch;
  Polyhedron sum = any_sum(without_labels(a, options.monitor), without_labels(b, options.monitor), options, r);
  r.seconds_total += watch.seconds();
  return sum;
}

}  // namespace nef::minkowski
