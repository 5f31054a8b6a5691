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
#include "apps/minkowski/sum/pair_sums.h"
#include "apps/minkowski/sum/unbounded_sum.h"
#include "nef/base/parallel.h"

namespace nef::minkowski {
namespace {

Polyhedron moved_by_point(const Polyhedron& a, const Polyhedron& point) {
  return transform(a, AffineMap::translate(point.complex().points.rational(PointId(0U))));
}

// Sums that need no decomposition.
std::optional<Polyhedron> simple_sum(const Polyhedron& a, const Polyhedron& b) {
  if (a.is_empty() || b.is_empty()) return Polyhedron();
  if (is_point(b)) return moved_by_point(a, b);
  if (is_point(a)) return moved_by_point(b, a);
  if (a.is_everything() || b.is_everything()) return Polyhedron::everything();
  return std::nullopt;
}

}  // namespace

Polyhedron minkowski_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                         MinkowskiReport* report) {
  MinkowskiReport unused;
  MinkowskiReport& r = report != nullptr ? *report : unused;
  PredicateCounts all;
  const PhaseTimer total(r.seconds_total, all);
  if (std::optional<Polyhedron> sum = simple_sum(a, b)) return *std::move(sum);
  if (!a.is_bounded() || !b.is_bounded()) return unbounded_sum(a, b, options, r);

  Operand cells_a;
  Operand cells_b;
  {
    const PhaseTimer timer(r.seconds_decomposition, r.predicates_decomposition);
    const bool only_open = (a.is_open() || b.is_open()) && is_full_dimensional(a) && is_full_dimensional(b);
    parallel_for(2, options.threads, [&](std::size_t k) {
      const Polyhedron& operand = k == 0 ? a : b;
      (k == 0 ? cells_a : cells_b) = Operand(only_open ? decompose_open(operand) : decompose(operand));
    });
  }
  r.cells_a += cells_a.size();
  r.cells_b += cells_b.size();
  PairSums sums(options, r);
  sums.add_product(cells_a, cells_b);
  return sums.run();
}

}  // namespace nef::minkowski
