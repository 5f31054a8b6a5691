// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/marks/sum_membership.h"

#include "apps/minkowski/minkowski.h"

namespace nef::minkowski {
SumMembership::SumMembership(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor)
    : a_(a), b_(b), turned_b_(negate(b, monitor)) {}

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

bool SumMembership::surely_in_inside(const Rational3& x, const Monitor& monitor) const {
  IntersectionQuery::Crossings recent;
  return surely_in_inside({approximation_of(x[0]), approximation_of(x[1]), approximation_of(x[2])}, recent, true,
                          monitor);
}

bool SumMembership::in_inside(const Rational3& x, const Monitor& monitor) const {
  std::call_once(insides_once_, [&] {
    insides_.emplace(interior(regularize(a_, monitor), monitor), interior(regularize(turned_b_, monitor), monitor));
  });
  return insides_->meet(x, monitor);
}

}  // namespace nef::minkowski
