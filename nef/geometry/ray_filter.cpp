// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/ray_filter.h"

#include <cmath>
#include <limits>

#include "nef/base/fast_path.h"

namespace nef {

RayFilter::RayFilter(const Box& origin, const Direction& direction) : origin_(origin) {
  const Integer3& exact = direction.integers();
  // Of a cross product, small components are known no better than the largest.
  const Direction each = Direction::exact(exact[0], exact[1], exact[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    direction_[i] = each.approximate[i];
    sign_[i] = sgn(exact[i]);
    if (std::fabs(direction_[i]) > std::fabs(direction_[main_])) main_ = i;
    reach_.low[i] = sign_[i] >= 0 ? origin_.low[i] : -HUGE_VAL;
    reach_.high[i] = sign_[i] <= 0 ? origin_.high[i] : HUGE_VAL;
  }
  // A component beside which doubles have no room: NaNs refuse nothing.
  for (std::size_t i = 0; i < 3; ++i) {
    if (sign_[i] != 0 && std::fabs(direction_[i]) < 0x1p-1000) direction_[i] = std::numeric_limits<double>::quiet_NaN();
  }
  axis_parallel_ = (sign_[0] == 0) + (sign_[1] == 0) + (sign_[2] == 0) == 2;
}

void RayFilter::cut(const Box& point) {
  if (sign_[main_] > 0) {
    reach_.high[main_] = point.high[main_];
  } else {
    reach_.low[main_] = point.low[main_];
  }
}

bool RayFilter::may_meet(const Box& box) const {
  if (!box.overlaps(reach_)) return false;
  if (!kFastPaths || axis_parallel_) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (sign_[i] != 0 && sign_[j] != 0 && !may_meet_projected(box, i, j)) return false;
  }
  return true;
}

// In the plane of axes i and j: f(x) = D_i (x_j - o_j) - D_j (x_i - o_i) vanishes on the ray.
// Refuses only if f has one sign on the whole box. The relative errors of a coordinate, of a
// component of D and of the arithmetic are below 2^-50 each; 2^-46 of the sum of magnitudes
// covers them all. Infinities give NaNs or infinite bounds, which refuse nothing.
bool RayFilter::may_meet_projected(const Box& box, std::size_t i, std::size_t j) const {
  const double a = direction_[i];
  const double b = direction_[j];
  double low = 0;
  double high = 0;
  double size = 0;
  const auto add = [&](double factor, double from, double to) {
    const double x = factor * from;
    const double y = factor * to;
    low += x < y ? x : y;
    high += x < y ? y : x;
    size += std::fabs(x) + std::fabs(y);
  };
  add(a, box.low[j] - origin_.high[j], box.high[j] - origin_.low[j]);
  add(-b, box.low[i] - origin_.high[i], box.high[i] - origin_.low[i]);
  size += std::fabs(a) * (std::fabs(origin_.low[j]) + std::fabs(box.low[j]) + std::fabs(box.high[j]));
  size += std::fabs(b) * (std::fabs(origin_.low[i]) + std::fabs(box.low[i]) + std::fabs(box.high[i]));
  const double bound = size * 0x1p-46 + 1e-300;
  return !(low > bound) && !(high < -bound);
}

}  // namespace nef
