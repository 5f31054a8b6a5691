// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/orientation/orientation_cells.h"

#include <algorithm>
#include <utility>

#include "nef/base/error.h"

namespace nef::planner {

bool are_proportional(const Quaternion& p, const Quaternion& q) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (p[i] * q[j] != p[j] * q[i]) return false;
    }
  }
  return true;
}

namespace {

// The component of a quaternion that is a parameter of the chart of component `chart`.
std::uint32_t component_of(std::uint32_t chart, std::uint32_t parameter) {
  return parameter < chart ? parameter : parameter + 1;
}

}  // namespace

Orientations Orientations::all() {
  Orientations result;
  for (std::uint32_t c = 0; c < 4; ++c) {
    Chart chart;
    chart.origin[c] = 1;
    for (std::uint32_t k = 0; k < 3; ++k) chart.directions.emplace_back()[component_of(c, k)] = 1;
    result.charts_.push_back(std::move(chart));
  }
  for (std::uint32_t c = 0; c < 4; ++c) {
    for (std::uint32_t e = c + 1; e < 4; ++e) {
      for (const int side : {1, -1}) {
        // q_c = 1 and q_e = side; times the side, q_e = 1 and q_c = side.
        ChartSeam seam{c, parameter_of(c, e), side, e, parameter_of(e, c), side, side, {}};
        for (std::uint32_t f = 0; f < 4; ++f) {
          if (f != c && f != e) seam.others.push_back({parameter_of(c, f), parameter_of(e, f)});
        }
        result.seams_.push_back(std::move(seam));
      }
    }
  }
  return result;
}

Orientations Orientations::along(const std::vector<Quaternion>& chain) {
  if (chain.size() < 2) throw InputError("a chain of orientations needs two quaternions");
  Orientations result;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    if (scalar_product(chain[i], chain[i + 1]) <= 0) {
      throw InputError("neighbours in a chain of orientations must be less than a half turn apart");
    }
    Chart chart;
    chart.directions.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      chart.origin[k] = (chain[i][k] + chain[i + 1][k]) / 2;
      chart.directions[0][k] = (chain[i + 1][k] - chain[i][k]) / 2;
    }
    result.charts_.push_back(std::move(chart));
  }
  return result;
}

std::optional<OrientationBox<Rational>> Orientations::locate(const Quaternion& q) {
  OrientationBox<Rational> result;
  for (std::uint32_t c = 1; c < 4; ++c) {
    if (abs(q[c]) > abs(q[result.chart])) result.chart = c;
  }
  if (q[result.chart] == 0) return std::nullopt;
  for (std::uint32_t k = 0; k < 3; ++k) {
    result.low[k] = result.high[k] = q[component_of(result.chart, k)] / q[result.chart];
  }
  return result;
}

namespace {

template <std::size_t N>
void take_denominators(const std::array<Rational, N>& numbers, Integer& common) {
  for (const Rational& x : numbers) common = lcm(common, x.get_den());
}

template <std::size_t N>
std::array<Integer, N> multiplied(const std::array<Rational, N>& numbers, const Integer& factor) {
  std::array<Integer, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = factor / numbers[i].get_den() * numbers[i].get_num();
  return result;
}

}  // namespace

// Parameters are multiplied by an even factor, the origin by this and that of the directions.
QuaternionBox<Integer> in_integers(const Orientations& orientations, const OrientationBox<Rational>& cell) {
  const Orientations::Chart& chart = orientations.charts()[cell.chart];
  Integer parts = 1;
  take_denominators(cell.low, parts);
  take_denominators(cell.high, parts);
  parts *= 2;
  Integer units = 1;
  take_denominators(chart.origin, units);
  for (const Quaternion& direction : chart.directions) take_denominators(direction, units);
  QuaternionBox<Integer> result{
      multiplied(chart.origin, units * parts), {}, multiplied(cell.low, parts), multiplied(cell.high, parts)};
  for (const Quaternion& direction : chart.directions) result.directions.push_back(multiplied(direction, units));
  return result;
}

std::vector<ScaledMatrix<Integer>> mixed_rotations(const Orientations& orientations,
                                                   const OrientationBox<Rational>& cell) {
  const QuaternionBox<Integer> box = in_integers(orientations, cell);
  return mixed_rotations(box.origin, box.directions, box.low, box.high);
}

}  // namespace nef::planner
