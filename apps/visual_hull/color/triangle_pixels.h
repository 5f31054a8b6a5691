// SPDX-License-Identifier: Apache-2.0
//
// The pixels of a triangle in the plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace nef::visual_hull {

using Place2 = std::array<double, 2>;
using Triangle2 = std::array<Place2, 3>;

/// A point of a triangle: the weights of its corners, which add up to one.
using Weights = std::array<double, 3>;

/// Twice the area, positive if the corners turn from the first axis to the second.
inline double doubled_area(const Triangle2& t) {
  return (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
}

/// The weights of a place, which are negative outside of the triangle. `area`: its doubled_area, not zero.
inline Weights weights_at(const Triangle2& t, double area, double x, double y) {
  const double s = ((x - t[0][0]) * (t[2][1] - t[0][1]) - (y - t[0][1]) * (t[2][0] - t[0][0])) / area;
  const double r = ((t[1][0] - t[0][0]) * (y - t[0][1]) - (t[1][1] - t[0][1]) * (x - t[0][0])) / area;
  return {1 - s - r, s, r};
}

/// The point of a triangle that is nearest to a place, and the square of its distance.
struct NearestPoint {
  Weights weights{1, 0, 0};
  double squared_distance = 0;
};

/// A triangle without area is its sides.
inline NearestPoint nearest_point(const Triangle2& t, double x, double y) {
  const double area = doubled_area(t);
  if (std::abs(area) > 1e-12) {
    const Weights w = weights_at(t, area, x, y);
    if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) return {w, 0};
  }
  NearestPoint nearest;
  nearest.squared_distance = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double dx = t[j][0] - t[i][0];
    const double dy = t[j][1] - t[i][1];
    const double length = dx * dx + dy * dy;
    const double along = length > 0 ? std::clamp(((x - t[i][0]) * dx + (y - t[i][1]) * dy) / length, 0.0, 1.0) : 0.0;
    const double ex = t[i][0] + along * dx - x;
    const double ey = t[i][1] + along * dy - y;
    if (ex * ex + ey * ey >= nearest.squared_distance) continue;
    nearest.squared_distance = ex * ex + ey * ey;
    nearest.weights = {};
    nearest.weights[i] = 1 - along;
    nearest.weights[j] = along;
  }
  return nearest;
}

/// Calls visit(x, y) for whole places of a frame, row by row, among them all within `reach` of the triangle.
/// Coordinates are below 1e9. O(1) for each row and each place that is visited.
template <typename Visit>
void for_each_pixel_near(const Triangle2& t, double reach, int width, int height, Visit&& visit) {
  const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
  const int top = static_cast<int>(std::max(0.0, std::ceil(low - reach)));
  const int bottom = static_cast<int>(std::min(height - 1.0, std::floor(high + reach)));
  for (int y = top; y <= bottom; ++y) {
    // The part of the triangle's sides that lies between the rows y - reach and y + reach.
    double left = INFINITY;
    double right = -INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
      const Place2& a = t[i];
      const Place2& b = t[(i + 1) % 3];
      const double up = y - reach;
      const double down = y + reach;
      if (std::max(a[1], b[1]) < up || std::min(a[1], b[1]) > down) continue;
      const auto x_at = [&](double row) {
        if (a[1] == b[1]) return a[0];
        return a[0] + std::clamp((row - a[1]) / (b[1] - a[1]), 0.0, 1.0) * (b[0] - a[0]);
      };
      for (const double x : {x_at(up), x_at(down)}) {
        left = std::min(left, x);
        right = std::max(right, x);
      }
      if (a[1] == b[1]) {
        left = std::min({left, a[0], b[0]});
        right = std::max({right, a[0], b[0]});
      }
    }
    const int first = static_cast<int>(std::clamp(std::ceil(left - reach), 0.0, 1e9));
    const int last = static_cast<int>(std::clamp(std::floor(right + reach), -1.0, width - 1.0));
    for (int x = first; x <= last; ++x) visit(x, y);
  }
}

}  // namespace nef::visual_hull
