// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/marks/sum_membership.h"

#include "apps/minkowski/minkowski.h"

namespace nef::minkowski {
namespace {

// What holds x - v for one of some vertices v of B: 2 if a volume of A, 1 if a point of its boundary that belongs to A,
// as v does to B, 0 if nothing.
int reach(const Polyhedron& a, const Polyhedron& b, const Rational3& x, const Monitor& monitor) {
  constexpr std::size_t kAsked = 32;
  const std::size_t count = b.complex().vertex_count();
  int best = 0;
  for (std::size_t i = 0; i < count; i += 1 + count / kAsked) {
    const VertexId v{i};
    const Rational3 p = b.complex().points.rational(point_of(v));
    const Location at = locate(a, {x[0] - p[0], x[1] - p[1], x[2] - p[2]}, monitor);
    if (at.mark == 0) continue;
    if (at.kind == Location::Kind::kVolume) return 2;
    if (b.complex().mark(v) != 0) best = 1;
  }
  return best;
}

}  // namespace

SumMembership::SumMembership(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor)
    : a_(a), b_(b), sets_{a, negate(b, monitor)} {}

bool SumMembership::meet(const Operands& operands, const Rational3& x, const Monitor& monitor) {
  const Polyhedron moved_b = transform(operands.turned_b, AffineMap::translate(x), monitor);
  return !intersect(operands.a, moved_b, 1, monitor).is_empty();
}

// A vertex of B is in its closure, so near it there is the inside of B; and so with A and B exchanged.
bool SumMembership::surely_in_inside(const Rational3& x, const Monitor& monitor) const {
  return reach(a_, b_, x, monitor) == 2 || reach(b_, a_, x, monitor) == 2;
}

bool SumMembership::in_sum(const Rational3& x, const Monitor& monitor) const {
  return reach(a_, b_, x, monitor) > 0 || reach(b_, a_, x, monitor) > 0 || meet(sets_, x, monitor);
}

bool SumMembership::in_closure(const Rational3& x, const Monitor& monitor) const {
  if (reach(a_, b_, x, monitor) > 0 || reach(b_, a_, x, monitor) > 0) return true;
  std::call_once(closures_once_, [&] { closures_ = Operands{closure(a_, monitor), closure(sets_.turned_b, monitor)}; });
  return meet(*closures_, x, monitor);
}

bool SumMembership::in_inside(const Rational3& x, const Monitor& monitor) const {
  if (surely_in_inside(x, monitor)) return true;
  std::call_once(insides_once_, [&] {
    insides_ =
        Operands{interior(regularize(a_, monitor), monitor), interior(regularize(sets_.turned_b, monitor), monitor)};
  });
  return meet(*insides_, x, monitor);
}

}  // namespace nef::minkowski
