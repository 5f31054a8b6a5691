// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// Rational bounds of how far a motion from p to q that turns evenly has come when its rotation is at (1 - s) p + s q:
/// the angle from p to there, divided by that from p to q. The scalar product of p and q must not be negative, and s
/// must lie between 0 and 1. The bounds are some 2^-60 apart.
std::array<Rational, 2> time_bounds(const Quaternion& p, const Quaternion& q, const Rational& s);

}  // namespace nef::planner
