// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/orientation/rotations.h"

#include <algorithm>
#include <cmath>

#include "nef/number/floor.h"

namespace nef::planner {
namespace {

std::size_t largest_of(const Quaternion& q) {
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 4; ++k) {
    if (abs(q[k]) > abs(q[largest])) largest = k;
  }
  return largest;
}

Rational unit_of(unsigned level) { return Rational(1, 1UL << level); }

bool is_multiple(const Rational& x, const Rational& unit) { return Rational(x / unit).get_den() == 1; }

}  // namespace

Quaternion canonical(const Quaternion& q) {
  const Rational& scale = q[largest_of(q)];
  Quaternion result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = q[k] / scale;
  return result;
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

double angle_between(const Quaternion& p, const Quaternion& q) {
  std::array<double, 4> a{};
  std::array<double, 4> b{};
  for (std::size_t k = 0; k < 4; ++k) {
    a[k] = nearest_double(p[k]);
    b[k] = nearest_double(q[k]);
  }
  const auto dot = [](const auto& x, const auto& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3]; };
  const double cosine = std::fabs(dot(a, b)) / std::sqrt(dot(a, a) * dot(b, b));
  // The chord between the quaternions is 2 sin(angle / 4); its series without the terms of fifth order.
  const double half = std::sqrt(std::max(0.0, (1 - cosine) / 2));
  return 4 * half * (1 + half * half / 6);
}

Quaternion rotation_at(const Quaternion& from, const Quaternion& to, const Rational& s) {
  const bool opposite = scalar_product(from, to) < 0;
  Quaternion result;
  for (std::size_t k = 0; k < 4; ++k) {
    const Rational end = opposite ? Rational(-to[k]) : to[k];
    result[k] = from[k] + s * (end - from[k]);
  }
  return result;
}

bool is_in_grid(const Quaternion& q, unsigned level) {
  const Rational unit = unit_of(level);
  return std::all_of(q.begin(), q.end(), [&](const Rational& x) { return is_multiple(x, unit); });
}

std::vector<Quaternion> grid_neighbours(const Quaternion& q, unsigned level) {
  const Rational unit = unit_of(level);
  std::vector<Quaternion> result;
  // For each coordinate the multiples of the unit next to it.
  std::array<std::vector<Rational>, 4> choices;
  const bool inside = is_in_grid(q, level);
  for (std::size_t k = 0; k < 4; ++k) {
    const Rational low = Rational(floor_of(Rational(q[k] / unit))) * unit;
    if (inside) {
      choices[k] = {Rational(low - unit), low, Rational(low + unit)};
    } else {
      choices[k] = {low};
      if (low != q[k]) choices[k].push_back(low + unit);
    }
  }
  for (const Rational& w : choices[0]) {
    for (const Rational& x : choices[1]) {
      for (const Rational& y : choices[2]) {
        for (const Rational& z : choices[3]) {
          const Quaternion next{w, x, y, z};
          if (abs(next[largest_of(next)]) != 1 || next == q) continue;
          if (scalar_product(next, q) > 0) result.push_back(canonical(next));  // else a half turn away
        }
      }
    }
  }
  return result;
}

Quaternion rounded_to_grid(const std::array<double, 4>& q, unsigned level) {
  double largest = 0;
  for (const double x : q) largest = std::max(largest, std::fabs(x));
  Quaternion result;
  for (std::size_t k = 0; k < 4; ++k) {
    result[k] = exact_rational(std::round(q[k] / largest * static_cast<double>(1U << level))) * unit_of(level);
  }
  return canonical(result);
}

}  // namespace nef::planner
