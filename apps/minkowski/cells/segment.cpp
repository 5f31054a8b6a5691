// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/cells/segment.h"

#include <algorithm>
#include <cmath>

namespace nef::minkowski {

Box Segment::box() const {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::min(from[i], to[i]) - error;
    box.high[i] = std::max(from[i], to[i]) + error;
  }
  return box;
}

Box Segment::box_of(const Interval& part) const {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double slope = to[i] - from[i];
    const double a = from[i] + part.low * slope;
    const double b = from[i] + part.high * slope;
    // One difference, one product and one sum, of numbers below twice the sum of the two, for parameters in [0, 1]: at
    // most three times 2u of that sum.
    const double slack = error + 8 * kUnit * (std::fabs(from[i]) + std::fabs(to[i]));
    box.low[i] = std::min(a, b) - slack;
    box.high[i] = std::max(a, b) + slack;
  }
  return box;
}

bool clip_to_box(const Segment& s, const Box& box, Interval& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double slope = s.to[i] - s.from[i];
    keep_below(t, s.from[i], slope, box.high[i] + s.error, Rounding::kOutwards);
    keep_below(t, -s.from[i], -slope, -box.low[i] + s.error, Rounding::kOutwards);
  }
  return t.low <= t.high;
}

void subtract(std::vector<Interval>& open, const Interval& inside, std::vector<Interval>& scratch) {
  scratch.clear();
  for (const Interval& t : open) {
    if (inside.high <= t.low || inside.low >= t.high) {
      scratch.push_back(t);
      continue;
    }
    if (t.low <= inside.low) scratch.push_back({t.low, inside.low});
    if (inside.high <= t.high) scratch.push_back({inside.high, t.high});
  }
  std::swap(open, scratch);
}

}  // namespace nef::minkowski
