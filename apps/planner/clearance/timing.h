// SPDX-License-Identifier: Apache-2.0
//
// When the robot is where on its path.
#pragma once

#include <vector>

namespace nef::planner {

/// Speed and acceleration of the reference point; without an acceleration it starts and stops at once.
struct MotionLimits {
  double speed = 1;
  double acceleration = 0;  ///< 0: without bound
};

/// The time to go so far, from rest to rest: full acceleration, full speed if it gets there, full braking.
double seconds_for(double length, const MotionLimits& limits);

/// When each way-point is reached, the first at 0: the robot rests at each, since the direction changes there at once.
/// `lengths` are those of the ways between them.
std::vector<double> times_of(const std::vector<double>& lengths, const MotionLimits& limits);

}  // namespace nef::planner
