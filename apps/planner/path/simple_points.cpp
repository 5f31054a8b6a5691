// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/simple_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/planner/free_space/segments.h"
#include "nef/number/floor.h"
#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

using Points = std::vector<Rational3>;

Integer power_of_ten(unsigned exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, exponent);
  return power;
}

// What doubles cannot tell apart in a sum of a few lengths.
constexpr double kRounding = 1e-13;

double length_of(const Points& path, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += distance(path[i], path[i + 1]);
  return sum;
}

// Takes `points` for the part of the path from `first` on if that is allowed and no longer.
bool take(const SegmentCheck& allowed, Points& path, std::size_t first, const Points& points) {
  const std::size_t last = first + points.size() - 1;
  if (length_of(points, 0, points.size() - 1) > length_of(path, first, last) * (1 + kRounding)) return false;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const bool is_new = points[i] != path[first + i] || points[i + 1] != path[first + i + 1];
    if (is_new && !allowed(points[i], points[i + 1])) return false;
  }
  std::copy(points.begin(), points.end(), path.begin() + static_cast<std::ptrdiff_t>(first));
  return true;
}

// Between way-points with the same coordinate, farthest apart first.
void keep_constant(const SegmentCheck& allowed, Points& path, std::size_t k) {
  for (std::size_t i = 0; i + 2 < path.size(); ++i) {
    for (std::size_t j = path.size() - 1; j > i + 1; --j) {
      if (path[j][k] != path[i][k]) continue;
      Points points(path.begin() + static_cast<std::ptrdiff_t>(i), path.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      for (Rational3& p : points) p[k] = path[i][k];
      if (take(allowed, path, i, points)) {
        i = j - 1;
        break;
      }
    }
  }
}

// One way-point, one coordinate: that of a neighbour, or a simple number near by.
void simplify(const SegmentCheck& allowed, Points& path, std::size_t i, std::size_t k) {
  const Rational x = path[i][k];
  constexpr unsigned kSimple = 256;  // corners of what people draw stay without being asked about
  if (x == path[i - 1][k] || x == path[i + 1][k] || x.get_den() <= kSimple) return;
  const double reach = std::min(distance(path[i - 1], path[i]), distance(path[i], path[i + 1]));
  std::vector<Rational> candidates{path[i - 1][k], path[i + 1][k]};
  for (const double share : {0.1, 0.01, 0.001}) {
    const Rational near = exact_rational(reach * share);
    candidates.push_back(simplest_between(x - near, x + near));
  }
  for (const Rational& candidate : candidates) {
    if (candidate == x) continue;
    Points points(path.begin() + static_cast<std::ptrdiff_t>(i) - 1, path.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    points[1][k] = candidate;
    if (take(allowed, path, i - 1, points)) return;
  }
}

}  // namespace

void straighten(const SegmentCheck& allowed, Points& path) {
  for (std::size_t k = 0; k < 3; ++k) {
    keep_constant(allowed, path, k);
    for (std::size_t i = 1; i + 1 < path.size(); ++i) simplify(allowed, path, i, k);
  }
}

Rational rounded(const Rational& x, unsigned digits) {
  const Integer power = power_of_ten(digits);
  Rational result(floor_of(x * power + Rational(1, 2)), power);
  result.canonicalize();
  return result;
}

Rational rounded_up(const Rational& x, unsigned digits) {
  const Integer power = power_of_ten(digits);
  Rational result(ceiling_of(x * power), power);
  result.canonicalize();
  return result;
}

std::vector<Rational3> rounded_points(const Rational3& x, unsigned digits) {
  std::array<std::array<Rational, 2>, 3> choices;  // the nearest multiple, and the next one on the other side
  const Rational unit(1, power_of_ten(digits));
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational near = rounded(x[k], digits);
    choices[k] = {near, near == x[k] ? near : near > x[k] ? Rational(near - unit) : Rational(near + unit)};
  }
  std::vector<Rational3> result;
  for (const unsigned which : {7U, 6U, 5U, 3U, 4U, 2U, 1U}) {
    std::vector<std::pair<double, Rational3>> group;
    for (unsigned far = 0; far < 8; ++far) {
      if ((far & ~which) != 0) continue;
      Rational3 point = x;
      for (std::size_t k = 0; k < 3; ++k) {
        if ((which >> k & 1U) != 0) point[k] = choices[k][far >> k & 1U];
      }
      if (point != x) group.emplace_back(distance(x, point), point);
    }
    std::stable_sort(group.begin(), group.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [far, point] : group) {
      if (std::find(result.begin(), result.end(), point) == result.end()) result.push_back(std::move(point));
    }
  }
  return result;
}

bool is_rounded(const Rational3& x, unsigned digits) {
  return std::all_of(x.begin(), x.end(), [&](const Rational& value) { return rounded(value, digits) == value; });
}

std::vector<std::size_t> unrounded_points(const Points& path, unsigned digits) {
  std::vector<std::size_t> result;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    if (!is_rounded(path[i], digits)) result.push_back(i);
  }
  return result;
}

std::vector<std::size_t> round_points(const SegmentCheck& allowed, Points& path, unsigned digits) {
  for (const std::size_t i : unrounded_points(path, digits)) {
    for (const Rational3& point : rounded_points(path[i], digits)) {
      if (!allowed(path[i - 1], point) || !allowed(point, path[i + 1])) continue;
      path[i] = point;
      break;
    }
  }
  return unrounded_points(path, digits);
}

}  // namespace nef::planner
