// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/marks/sum_membership.h"

#include <tuple>

namespace nef::minkowski {
namespace {

Polyhedron closed(const Polyhedron& set, const Monitor& monitor) {
  return set.is_closed() ? set : closure(set, monitor);
}

}  // namespace

bool SumMembership::in_sum(const Rational3& x, const Monitor& monitor) const {
  std::call_once(sets_once_, [&] { sets_.emplace(a_, turned_b_); });
  return sets_->meet(x, monitor);
}

const IntersectionQuery& SumMembership::closures(const Monitor& monitor) const {
  std::call_once(closures_once_, [&] { closures_.emplace(closed(a_, monitor), closed(turned_b_, monitor)); });
  return *closures_;
}

void SumMembership::prepare(const Monitor& monitor) const { std::ignore = closures(monitor); }

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
