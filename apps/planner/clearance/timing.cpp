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

std::vector<std::size_t> distinct_times(const std::vector<double>& times) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (result.empty() || times[i] > times[result.back()]) {
      result.push_back(i);
    } else if (i + 1 == times.size() && result.size() > 1) {
      result.back() = i;
    }
  }
  return result;
}

}  // namespace nef::planner
