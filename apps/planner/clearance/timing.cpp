// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/clearance/timing.h"

#include <cmath>

namespace nef::planner {

double seconds_for(double length, const MotionLimits& limits) {
  if (limits.acceleration <= 0) return length / limits.speed;
  const double to_full_speed = limits.speed * limits.speed / limits.acceleration;  // and back to rest
  if (length < to_full_speed) return 2 * std::sqrt(length / limits.acceleration);
  return length / limits.speed + limits.speed / limits.acceleration;
}

std::vector<double> times_of(const std::vector<double>& lengths, const MotionLimits& limits) {
  std::vector<double> times{0};
  for (const double length : lengths) times.push_back(times.back() + seconds_for(length, limits));
  return times;
}

}  // namespace nef::planner
