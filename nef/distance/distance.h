// SPDX-License-Identifier: Apache-2.0
//
// How far apart two sets are.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef {

/// How two sets stand to each other.
enum class Contact : std::uint8_t {
  kDisjoint,    ///< the distance is positive
  kTouching,    ///< the closures share a point, the interiors none
  kOverlapping  ///< the interiors share a point
};

/// "disjoint", "touching" or "overlapping": how reports and Python spell it.
std::string_view contact_name(Contact contact);

/// The exact distance of the closures of two sets, i.e. the infimum over pairs of points of the sets.
struct Distance {
  Contact contact = Contact::kDisjoint;
  /// True if some point is in both sets: openness counts, so a closed and an open cube may touch without it.
  bool common_point = false;
  Rational squared;  ///< the square of the distance, which is rational where the distance need not be
  /// Points of the closures at that distance; the same point if it is zero.
  Rational3 on_a;
  Rational3 on_b;

  /// The distance, within an ulp.
  [[nodiscard]] double value() const;
};

/// The distance of two sets, bounded or not; nothing if one of them is empty. Of several nearest pairs the same one is
/// found each time. O(n log n) for well-shaped sets; where the sets meet, one Boolean operation more.
std::optional<Distance> distance(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});

}  // namespace nef
