// SPDX-License-Identifier: Apache-2.0
//
// Vectors of three numbers, exact or double: for construction and pictures, where few are needed. Predicates on many
// points have tables of their own; linear algebra in doubles goes through Eigen.
#pragma once

#include <array>

namespace nef {

template <class Number>
std::array<Number, 3> minus(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]), Number(a[0] * b[1] - a[1] * b[0])};
}

template <class Number>
bool is_zero(const std::array<Number, 3>& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

}  // namespace nef
