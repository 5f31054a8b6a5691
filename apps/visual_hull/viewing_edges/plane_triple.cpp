// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/plane_triple.h"

#include <algorithm>
#include <cmath>

#include "nef/geometry/vectors.h"

namespace nef::visual_hull {
namespace {

// Of sums of products of three values, as a part of the product of their sizes. u = 2^-53. A component of a cross
// product of two normals is off by 2u of the two products and u for their difference: 3u of the product of sizes. Times
// a third value and summed with two more such terms: u for the products, 2u for the sums: 6u of each of three terms,
// whose magnitudes sum up to 6 products of sizes at most: 36u. 512u also leaves room for the roundings of the bounds.
constexpr double kProductRounding = 0x1p-44;

}  // namespace

// A line misses a cube if one of the directions across the line and a side tells them apart.
bool may_meet_in_cube(const CubePlane& p, const CubePlane& q, const Double3& direction) {
  const double slack = 2 * (p.size * q.error + q.size * p.error) + kProductRounding * p.size * q.size;
  const auto passes = [&](std::size_t k, std::size_t l, std::size_t m) {
    return std::abs(p.normal[k] * q.offset - q.normal[k] * p.offset) <=
           std::abs(direction[l]) + std::abs(direction[m]) + slack;
  };
  return passes(0, 1, 2) && passes(1, 2, 0) && passes(2, 0, 1);
}

// Cramer's rule. With errors r of the planes' values at the true point x in the cube, what is found is off by S^-1 r, S
// the matrix of the normals; its columns are the cross products over the determinant.
Answer meet_in_cube(const CubePlane& p, const CubePlane& q, const CubePlane& r, const Double3& pq, const Double3& pr,
                    const Double3& qr, CubePoint& result) {
  const double determinant = nef::dot(pq, r.normal);
  const double rounding = kProductRounding * p.size * q.size * r.size;
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    result.at[k] = q.offset * pr[k] - p.offset * qr[k] - r.offset * pq[k];
    const double bound =
        1.01 * (std::abs(qr[k]) * p.error + std::abs(pr[k]) * q.error + std::abs(pq[k]) * r.error) + 2 * rounding;
    if (std::abs(result.at[k]) > std::abs(determinant) + bound) return Answer::kNo;
    largest = std::max(largest, bound);
  }
  result.error = 1.01 * largest / (std::abs(determinant) - rounding);
  // A point too near to the border of the cube for this is surely in the cube of a neighbour.
  if (!(std::abs(determinant) > 2 * rounding && result.error < kOverlap / 8)) return Answer::kVague;
  for (std::size_t k = 0; k < 3; ++k) {
    result.at[k] /= determinant;
    if (std::abs(result.at[k]) + result.error > 1) return Answer::kNo;
  }
  return Answer::kYes;
}

}  // namespace nef::visual_hull
