// SPDX-License-Identifier: Apache-2.0
//
// Vectors of three numbers, exact or double: for construction and pictures, where few are needed. Predicates on many
// points have tables of their own; linear algebra in doubles goes through Eigen.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace nef {

/// A point or vector near an exact one, with what is known of its errors beside it: the proofs of filters count the
/// roundings of every product, so they are written out. What is no filter uses Eigen.
using Double3 = std::array<double, 3>;

template <class Number>
std::array<Number, 3> plus(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[0] + b[0]), Number(a[1] + b[1]), Number(a[2] + b[2])};
}

template <class Number>
std::array<Number, 3> minus(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <class Number>
std::array<Number, 3> opposite(const std::array<Number, 3>& v) {
  return {Number(-v[0]), Number(-v[1]), Number(-v[2])};
}

template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]), Number(a[0] * b[1] - a[1] * b[0])};
}

/// A vector at right angles to another one, which is not zero.
template <class Number>
std::array<Number, 3> across(const std::array<Number, 3>& v) {
  if (v[0] == 0 && v[1] == 0) return {Number(1), Number(0), Number(0)};
  return {Number(-v[1]), v[0], Number(0)};
}

/// The mean of some points, at least one.
template <class Number>
std::array<Number, 3> mean_of(std::span<const std::array<Number, 3>> points) {
  std::array<Number, 3> sum{};
  for (const std::array<Number, 3>& p : points) sum = plus(sum, p);
  for (Number& x : sum) x /= static_cast<unsigned>(points.size());
  return sum;
}

template <class Number>
bool is_zero(const std::array<Number, 3>& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

/// A normal of the plane of points that lie in one, on the side from which the first three that are on no line turn
/// counterclockwise; zero if all lie on a line. Points may repeat.
template <class Number>
std::array<Number, 3> normal_of(std::span<const std::array<Number, 3>> points) {
  std::array<Number, 3> normal{};
  for (std::size_t i = 1; i + 1 < points.size() && is_zero(normal); ++i) {
    normal = cross(minus(points[i], points[0]), minus(points[i + 1], points[0]));
  }
  return normal;
}

}  // namespace nef
