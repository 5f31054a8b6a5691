// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/distance/intersects.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// Answers by the definition: x is in A + B iff A meets x - B. Queries are made when they are needed, and answer for
/// all points. May be asked from several threads at once.
class SumMembership {
 public:
  /// A, and the points -x of all x in B, for two sets that lie in the closures of their interiors. Keeps copies, which
  /// are O(1).
  SumMembership(const Polyhedron& a, const Polyhedron& turned_b) : a_(a), turned_b_(turned_b) {}

  /// Makes the query that most questions take, which the first of them does otherwise while other threads wait. O(n log
  /// n).
  void prepare(const Monitor& monitor) const;

  /// True for a point of the closure of the sum.
  [[nodiscard]] bool in_closure(const Rational3& x, const Monitor& monitor) const;
  /// True for a point of the sum.
  [[nodiscard]] bool in_sum(const Rational3& x, const Monitor& monitor) const;
  /// True for a point of the sum of the interiors of the closures; also where single points of the sets are missing.
  [[nodiscard]] bool in_inside(const Rational3& x, const Monitor& monitor) const;
  /// True only if all points within the errors lie in the sum of the interior of one set and the other one, and of both
  /// interiors if both have one. In doubles (IntersectionQuery::surely_cross).
  [[nodiscard]] bool surely_in_inside(const Approximation3& x, IntersectionQuery::Crossings& recent, bool search,
                                      const Monitor& monitor) const;
  /// The same of one point, by a search.
  [[nodiscard]] bool surely_in_inside(const Rational3& x, const Monitor& monitor) const;

 private:
  [[nodiscard]] const IntersectionQuery& closures(const Monitor& monitor) const;

  Polyhedron a_, turned_b_;
  // Made when they are needed.
  mutable std::once_flag sets_once_, closures_once_, insides_once_;
  mutable std::optional<IntersectionQuery> sets_, closures_, insides_;
};

/// Asks for many points, near each other, whether they surely lie in the inside of the sum. A search that finds nothing
/// takes several times as long as one that does, and as what a point costs that is kept: where not most find something,
/// only what was found before is tried. Answers depend on the points asked before. Not to be shared between threads.
class InsideSearch {
 public:
  /// The membership must outlive the object.
  InsideSearch(const SumMembership& membership, const Monitor& monitor) : membership_(membership), monitor_(monitor) {}

  /// True only if SumMembership::surely_in_inside is.
  bool has(const Approximation3& x) {
    constexpr std::size_t kFree = 4;
    const bool search = searches_ < kFree || 4 * found_ >= 3 * searches_;
    const bool inside = membership_.surely_in_inside(x, recent_, search, monitor_);
    searches_ += search ? 1 : 0;
    found_ += search && inside ? 1 : 0;
    return inside;
  }

 private:
  const SumMembership& membership_;
  Monitor monitor_;
  IntersectionQuery::Crossings recent_;
  std::size_t searches_ = 0, found_ = 0;
};

}  // namespace nef::minkowski
