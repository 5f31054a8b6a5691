// SPDX-License-Identifier: Apache-2.0
//
// Vectors of integers, for directions in which a point is moved by an infinitely small amount.
#pragma once

#include <array>

#include "apps/planner/partition/space_tree.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {

/// x, y and z.
inline const std::array<Nudge, 3>& axes() {
  static const std::array<Nudge, 3> value{Nudge{1, 0, 0}, Nudge{0, 1, 0}, Nudge{0, 0, 1}};
  return value;
}

/// Some vector across n, which must not be zero.
inline Nudge across(const Nudge& n) {
  for (const Nudge& axis : axes()) {
    Nudge u = cross(n, axis);
    if (!is_zero(u)) return u;
  }
  return n;
}

}  // namespace nef::planner
