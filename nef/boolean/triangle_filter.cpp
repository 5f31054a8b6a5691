// SPDX-License-Identifier: Apache-2.0
//
// The line ab meets the triangle iff the determinants [b - a, u - a, v - a] of its three edges uv, in turn, have one
// sign or vanish. So two that surely differ are proof that it does not.
//
// The bound: doubles of coordinates of size at most m are within 4 u m of the truth (point_table.h), u = 2^-53, so a
// difference of two is off by e = 10 u m: 8 u m inherited, and a rounding of at most 2 u m. Let s be the largest
// difference, and e <= s / 16. A determinant is a sum of six products of three differences, each off by less than
// 3 s^2 e (1 + 1/15), 193 u m s^2 in all; each product takes part in five roundings of at most u times 6 s^3 (1 + 5 u).
// Near the limits of doubles products lose more: s has to lie between 2^-300 and 2^300. What is infinite or undefined
// fails a comparison.
#include "nef/boolean/triangle_filter.h"

#include <algorithm>
#include <cmath>

#include "nef/base/fast_path.h"
#include "nef/geometry/vectors.h"
#include "nef/number/approximation.h"

namespace nef {

bool surely_misses_triangle(const PointTable& points, PointId a, PointId b, const std::array<PointId, 3>& triangle) {
  if (!kFastPaths) return false;
  const Double3& origin = points.approximate(a);
  double coordinate = 0;
  double size = 0;
  const auto from_origin = [&](PointId point) {
    const Double3& p = points.approximate(point);
    Double3 d{};
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = p[i] - origin[i];
      coordinate = std::max(coordinate, std::fabs(p[i]));
      size = std::max(size, std::fabs(d[i]));
    }
    return d;
  };
  const Double3 line = from_origin(b);
  const std::array<Double3, 3> corner{from_origin(triangle[0]), from_origin(triangle[1]), from_origin(triangle[2])};
  coordinate = std::max({coordinate, std::fabs(origin[0]), std::fabs(origin[1]), std::fabs(origin[2])});
  if (!(size > 0x1p-300 && size < 0x1p300 && 160 * kRoundingUnit * coordinate <= size)) return false;
  const double bound = size * size * kRoundingUnit * (200 * coordinate + 40 * size);
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Double3& u = corner[i];
    const Double3& v = corner[(i + 1) % 3];
    const double turn = line[0] * (u[1] * v[2] - u[2] * v[1]) + line[1] * (u[2] * v[0] - u[0] * v[2]) +
                        line[2] * (u[0] * v[1] - u[1] * v[0]);
    if (turn > bound) left = true;
    if (turn < -bound) right = true;
  }
  return left && right;
}

}  // namespace nef
