// SPDX-License-Identifier: Apache-2.0
//
// Directions in doubles, side by side in memory, for questions that are asked of each pair of many.
#pragma once

#include <array>
#include <cstddef>

#include "nef/geometry/predicates.h"
#include "nef/number/approximation.h"

namespace nef::minkowski {

/// A vector in doubles.
struct NearVector {
  std::array<double, 3> at{};
  double size = 1;   ///< of its components, at most
  double error = 0;  ///< of each
};

/// Components of a direction are at most 1, and a little by which they round.
inline NearVector near_vector(const Direction& d) { return {d.approximate, 1 + 0x1p-40, d.error}; }

/// The sign of u . v, if doubles tell, else 0. Three products are off by the errors of their factors; their rounding
/// and that of two sums are below 8 units of 2^-53 of the product of the sizes, and the factor covers the product of
/// errors, which are far below sizes, and the rounding of the bound.
inline int sure_sign_of_dot(const NearVector& u, const NearVector& v) {
  const double value = u.at[0] * v.at[0] + u.at[1] * v.at[1] + u.at[2] * v.at[2];
  const double bound = 3.1 * (u.error * v.size + v.error * u.size) + 16 * kRoundingUnit * u.size * v.size;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

/// u x v. Two products and a difference, as above.
inline NearVector near_cross(const NearVector& u, const NearVector& v) {
  NearVector result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result.at[i] = u.at[j] * v.at[k] - u.at[k] * v.at[j];
  }
  result.size = 2 * (1 + 0x1p-40) * u.size * v.size;
  result.error = 2.1 * (u.error * v.size + v.error * u.size) + 16 * kRoundingUnit * u.size * v.size;
  return result;
}

}  // namespace nef::minkowski
