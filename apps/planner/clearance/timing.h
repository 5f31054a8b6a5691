// SPDX-License-Identifier: Apache-2.0
//
// When the robot is where on its path.
#pragma once

#include <cstddef>
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

/// The way-points of a list with time stamps, by their numbers: each is later than the one before. Of those that follow
/// each other closer than doubles can tell the first one counts, at the end the last one. Ascending times, the first 0.
std::vector<std::size_t> distinct_times(const std::vector<double>& times);

}  // namespace nef::planner
