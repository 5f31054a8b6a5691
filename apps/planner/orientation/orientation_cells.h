// SPDX-License-Identifier: Apache-2.0
//
// Cells of orientations: boxes of quaternions, and what a robot has in common over all orientations of one.
//
// A chart is an affine set of quaternions q(t) = origin + sum t_k directions[k], -1 <= t_k <= 1; a cell is a box of
// parameters in one chart. All rotations are covered by four charts, the facets of a cube in four dimensions with
// opposite ones identified: q_c = 1, and the other three components are the parameters. Rotations about one axis are a
// chain of arcs, each a chart with one parameter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// A box of parameters in a chart. Parameters that the chart does not have go from -1 to 1.
template <class Number>
struct OrientationBox {
  std::uint32_t chart = 0;
  std::array<Number, 3> low{-1, -1, -1};
  std::array<Number, 3> high{1, 1, 1};
};

/// Where a facet of a chart is glued to another chart: there, a point has the parameter `there` = side, too, and the
/// others are those here multiplied by `sign`, in the order of `others` (parameter here, parameter there).
struct ChartSeam {
  std::uint32_t chart = 0;  ///< this chart
  std::uint32_t here = 0;   ///< the parameter that is `side` on the facet
  int side = 1;             ///< 1 or -1
  std::uint32_t other = 0;  ///< the chart beyond
  std::uint32_t there = 0;  ///< its parameter across the facet
  int other_side = 1;       ///< the value of that
  int sign = 1;             ///< what the other parameters are multiplied by
  std::vector<std::array<std::uint32_t, 2>> others;
};

/// The orientations that a robot may have, as charts.
class Orientations {
 public:
  struct Chart {
    Quaternion origin;
    std::vector<Quaternion> directions;
  };

  /// All rotations: four charts of three parameters.
  static Orientations all();
  /// The arcs from each quaternion of a chain to the next one, one parameter each. Throws InputError unless there are
  /// two and the scalar products of neighbours are positive.
  static Orientations along(const std::vector<Quaternion>& chain);

  [[nodiscard]] const std::vector<Chart>& charts() const { return charts_; }
  /// How many parameters a chart has: 3 or 1.
  [[nodiscard]] std::size_t dimension() const { return charts_.front().directions.size(); }
  /// Of all rotations: each facet of a chart that is glued, once.
  [[nodiscard]] const std::vector<ChartSeam>& seams() const { return seams_; }

  /// Of all rotations: the parameter that a component of a quaternion is in the chart of another component.
  [[nodiscard]] static std::uint32_t parameter_of(std::uint32_t chart, std::uint32_t component) {
    return component < chart ? component : component - 1;
  }

  /// Of all rotations: a chart and parameters of one; nothing for the zero quaternion.
  [[nodiscard]] static std::optional<OrientationBox<Rational>> locate(const Quaternion& q);

 private:
  std::vector<Chart> charts_;
  std::vector<ChartSeam> seams_;
};

/// Whether two quaternions stand for the same rotation: one is a multiple of the other.
bool are_proportional(const Quaternion& p, const Quaternion& q);

/// A matrix, and the positive number that divides it.
template <class Number>
struct ScaledMatrix {
  std::array<std::array<Number, 3>, 3> rows{};
  Number scale{0};
};

/// The rotation matrix of a quaternion, times its square.
template <class Number>
ScaledMatrix<Number> rotation_form(const std::array<Number, 4>& q) {
  const auto& [w, x, y, z] = q;
  ScaledMatrix<Number> m;
  m.rows[0] = {Number(w * w + x * x - y * y - z * z), Number(2 * (x * y - w * z)), Number(2 * (x * z + w * y))};
  m.rows[1] = {Number(2 * (x * y + w * z)), Number(w * w - x * x + y * y - z * z), Number(2 * (y * z - w * x))};
  m.rows[2] = {Number(2 * (x * z - w * y)), Number(2 * (y * z + w * x)), Number(w * w - x * x - y * y + z * z)};
  m.scale = w * w + x * x + y * y + z * z;
  return m;
}

/// Matrices M with R(q) v in the hull of all M v, for every q of a box and every vector v; empty if the box is too
/// large for that. Both the matrix B(q, q) and the square of q are quadratic in the parameters, so they are mixtures
/// of their Bernstein coefficients, with the same weights; M is the quotient of these, if all of the latter are
/// positive. The coefficient of an index 0, 1 or 2 for each parameter is the form at the lower end, the middle or the
/// upper end, less the form of half of the box's edge for each 1. 27 matrices for three parameters, 3 for one.
///
/// Hence, with n v <= c for all v of a piece, and (M n) u <= c for all M, R(q)^-1 u is in the piece's half-space for
/// all q: the *inner piece* is where this holds for all of its faces (R^-1 n is a mixture likewise: u R(q) n is one of
/// the u M n).
template <class Number>
std::vector<ScaledMatrix<Number>> mixed_rotations(const std::array<Number, 4>& origin,
                                                  const std::vector<std::array<Number, 4>>& directions,
                                                  const std::array<Number, 3>& low, const std::array<Number, 3>& high) {
  const std::size_t dimension = directions.size();
  std::vector<ScaledMatrix<Number>> edges;
  for (std::size_t k = 0; k < dimension; ++k) {
    std::array<Number, 4> edge;
    for (std::size_t i = 0; i < 4; ++i) edge[i] = directions[k][i] * (high[k] - low[k]) / 2;
    edges.push_back(rotation_form(edge));
  }
  std::size_t count = 1;
  for (std::size_t k = 0; k < dimension; ++k) count *= 3;
  std::vector<ScaledMatrix<Number>> result;
  for (std::size_t index = 0; index < count; ++index) {
    std::array<Number, 4> q = origin;
    for (std::size_t k = 0, rest = index; k < dimension; ++k, rest /= 3) {
      const Number t = rest % 3 == 0 ? low[k] : (rest % 3 == 2 ? high[k] : Number((low[k] + high[k]) / 2));
      for (std::size_t i = 0; i < 4; ++i) q[i] += t * directions[k][i];
    }
    ScaledMatrix<Number> m = rotation_form(q);
    for (std::size_t k = 0, rest = index; k < dimension; ++k, rest /= 3) {
      if (rest % 3 != 1) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) m.rows[i][j] -= edges[k].rows[i][j];
      }
      m.scale -= edges[k].scale;
    }
    if (m.scale <= 0) return {};
    result.push_back(std::move(m));
  }
  return result;
}

/// The quaternions of a box in a chart: origin + sum t_k directions[k], low <= t <= high.
template <class Number>
struct QuaternionBox {
  std::array<Number, 4> origin;
  std::vector<std::array<Number, 4>> directions;
  std::array<Number, 3> low, high;
};

/// A cell in integers: all quaternions are multiplied by a common factor, and the middles of parameters are integers.
QuaternionBox<Integer> in_integers(const Orientations& orientations, const OrientationBox<Rational>& cell);

/// The mixed rotations of a cell, in integers: numerators and divisors of all matrices have a common factor.
std::vector<ScaledMatrix<Integer>> mixed_rotations(const Orientations& orientations,
                                                   const OrientationBox<Rational>& cell);

}  // namespace nef::planner
