// SPDX-License-Identifier: Apache-2.0
#include "nef/import/generalized_winding.h"

#include <cmath>
#include <numbers>

#include "nef/geometry/vectors.h"

namespace nef {

GeneralizedWinding::GeneralizedWinding(const Mesh& mesh, std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Double3> points;
  for (const Rational3& v : mesh.vertices) {
    points.push_back(nearest_doubles(v));
  }
  corners_.reserve(triangles.size());
  for (const auto& t : triangles) corners_.push_back({points[t[0]], points[t[1]], points[t[2]]});
}

double GeneralizedWinding::around(const Rational3& point) const {
  const Double3 p = nearest_doubles(point);
  double sum = 0;  // of half the solid angles [Van Oosterom, Strackee 1983]
  for (const auto& triangle : corners_) {
    std::array<Double3, 3> to = triangle;
    std::array<double, 3> length{};
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = minus(to[k], p);
      length[k] = std::hypot(to[k][0], to[k][1], to[k][2]);
    }
    const double below = length[0] * length[1] * length[2] + dot(to[0], to[1]) * length[2] +
                         dot(to[1], to[2]) * length[0] + dot(to[2], to[0]) * length[1];
    sum += std::atan2(dot(to[0], cross(to[1], to[2])), below);
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace nef
