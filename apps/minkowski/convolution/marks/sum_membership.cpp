// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/marks/sum_membership.h"

#include "apps/minkowski/minkowski.h"

namespace nef::minkowski {
namespace {

// True if a volume of A holds x - v for one of some vertices v of B.
bool reach(const Polyhedron& a, const Polyhedron& b, const Rational3& x, const Monitor& monitor) {
  constexpr std::size_t kAsked = 32;
  const std::size_t count = b.complex().vertex_count();
  for (std::size_t i = 0; i < count; i += 1 + count / kAsked) {
    const Rational3 p = b.complex().points.rational(point_of(VertexId{i}));
    const Location at = locate(a, {x[0] - p[0], x[1] - p[1], x[2] - p[2]}, monitor);
    if (at.mark != 0 && at.kind == Location::Kind::kVolume) return true;
  }
  return false;
}

}  // namespace

SumMembership::SumMembership(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor)
    : a_(a), b_(b), turned_b_(negate(b, monitor)) {}

// A vertex of B is in its closure, so near it there is the inside of B; and so with A and B exchanged.
bool SumMembership::surely_in_inside(const Rational3& x, const Monitor& monitor) const {
  return reach(a_, b_, x, monitor) || reach(b_, a_, x, monitor);
}

bool SumMembership::in_sum(const Rational3& x, const Monitor& monitor) const {
  std::call_once(sets_once_, [&] { sets_.emplace(a_, turned_b_); });
  return sets_->meet(x, monitor);
}

const IntersectionQuery& SumMembership::closures(const Monitor& monitor) const {
  std::call_once(closures_once_, [&] { closures_.emplace(closure(a_, monitor), closure(turned_b_, monitor)); });
  return *closures_;
}

bool SumMembership::in_closure(const Rational3& x, const Monitor& monitor) const {
  return closures(monitor).meet(x, monitor);
}

bool SumMembership::surely_in_inside(const Approximation3& x, IntersectionQuery::Crossings& recent, bool search,
                                     const Monitor& monitor) const {
  return closures(monitor).surely_cross(x, recent, search);
}

bool SumMembership::in_inside(const Rational3& x, const Monitor& monitor) const {
  std::call_once(insides_once_, [&] {
    insides_.emplace(interior(regularize(a_, monitor), monitor), interior(regularize(turned_b_, monitor), monitor));
  });
  return insides_->meet(x, monitor);
}

}  // namespace nef::minkowski
