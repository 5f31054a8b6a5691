// SPDX-License-Identifier: Apache-2.0
//
// Vectors of integers, for directions in which a point is moved by an infinitely small amount.
#pragma once

#include <array>

#include "apps/planner/partition/space_tree.h"

namespace nef::planner {

inline Nudge cross(const Nudge& a, const Nudge& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// x, y and z.
inline const std::array<Nudge, 3>& axes() {
  static const std::array<Nudge, 3> value{Nudge{1, 0, 0}, Nudge{0, 1, 0}, Nudge{0, 0, 1}};
  return value;
}

/// Some vector across n, which must not be zero.
inline Nudge across(const Nudge& n) {
  for (const Nudge& axis : axes()) {
    Nudge u = cross(n, axis);
    if (u[0] != 0 || u[1] != 0 || u[2] != 0) return u;
  }
  return n;
}

}  // namespace nef::planner
