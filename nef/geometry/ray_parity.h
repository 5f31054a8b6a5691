// SPDX-License-Identifier: Apache-2.0
//
// Whether a point is inside of a polygon in whose plane it lies, as far as doubles tell.
#pragma once

#include <cstddef>

#include "nef/number/approximation.h"

namespace nef {

/// Counts the sides of a polygon that a ray from a point crosses, towards larger coordinates u: the point is inside iff
/// their number is odd. `u` and `v` are the two axes that are seen. A side that is surely behind the point, or above or
/// below the ray, does not matter; any other must surely begin on one side of the ray and end on the other, and pass
/// the point on one side. So where all sides are sure, the point is on none of them.
class RayParity {
 public:
  RayParity(const Approximation3& point, std::size_t u, std::size_t v) : point_(point), u_(u), v_(v) {}

  /// Shows the side from p to q. False if doubles do not tell whether the ray crosses it: nothing is known then.
  bool add(const Approximation3& p, const Approximation3& q) {
    const Approximation pv = p[v_] - point_[v_];
    const Approximation qv = q[v_] - point_[v_];
    const int p_side = pv.sign().value_or(0);
    const int q_side = qv.sign().value_or(0);
    if (p_side * q_side > 0) return true;
    const Approximation pu = p[u_] - point_[u_];
    const Approximation qu = q[u_] - point_[u_];
    if (pu.sign().value_or(0) < 0 && qu.sign().value_or(0) < 0) return true;
    if (p_side * q_side == 0) return false;
    const int turn = (pu * qv - pv * qu).sign().value_or(0);
    if (turn == q_side) inside_ = !inside_;
    return turn != 0;
  }

  /// Once all sides were shown, and all of them were sure.
  [[nodiscard]] bool is_inside() const { return inside_; }

 private:
  Approximation3 point_;
  std::size_t u_;
  std::size_t v_;
  bool inside_ = false;
};

}  // namespace nef
