// SPDX-License-Identifier: Apache-2.0
//
// Vectors of doubles, for lengths and guesses. Nothing that must be exact goes through them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "nef/number/number.h"

namespace nef::planner {

using Eigen::Vector3d;

/// Each coordinate rounded to the nearest double.
inline Vector3d to_vector(const Rational3& p) {
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}
inline Vector3d to_vector(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
/// The direction of a vector that is not zero, of length 1, each coordinate within 2^-51. The vector is scaled before
/// it is rounded: those of huge and tiny faces are no doubles.
inline Vector3d direction_of(const Rational3& v) {
  Rational largest = 0;
  for (const Rational& x : v) {
    if (abs(x) > largest) largest = abs(x);
  }
  return to_vector(Rational3{v[0] / largest, v[1] / largest, v[2] / largest}).normalized();
}
inline std::array<double, 3> to_array(const Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace nef::planner
