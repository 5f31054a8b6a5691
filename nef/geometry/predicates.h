// SPDX-License-Identifier: Apache-2.0
//
// The few questions that everything above asks of coordinates. Each is a sign, answered by a named
// ladder: by identity (same row of the plane table), then by a double filter whose bound is
// derived beside its constant, then exactly. All answers are exact; only their cost differs, and
// who counts them is told which it was.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "nef/base/monitor.h"
#include "nef/geometry/plane_table.h"
#include "nef/geometry/point_table.h"
#include "nef/number/approximation.h"

namespace nef {

/// The form of an unflipped plane at a point, both as their tables approximate them. Each product is off by 4u + 4u + u
/// plus higher terms, u = 2^-53, the offset by 4u, and three additions by 3u of the sum of magnitudes: 13u in all; 16u
/// is safe. The absolute term covers underflow.
inline Approximation approximate_form(const std::array<double, 4>& plane, const std::array<double, 3>& point) {
  const double t0 = plane[0] * point[0];
  const double t1 = plane[1] * point[1];
  const double t2 = plane[2] * point[2];
  const double sizes = std::fabs(t0) + std::fabs(t1) + std::fabs(t2) + std::fabs(plane[3]);
  return {t0 + t1 + t2 + plane[3], 16 * kRoundingUnit * sizes + 1e-300};
}

/// a - b for two coordinates as a point table approximates them: 4u of each, u of the difference.
inline Approximation approximate_difference(double a, double b) {
  return {a - b, 6 * kRoundingUnit * (std::fabs(a) + std::fabs(b)) + 1e-300};
}

/// The sign of the plane's form at the point: +1 on its positive side, 0 on the plane.
int side_of_plane(const PlaneTable& planes, PlaneId plane, const PointTable& points, PointId point,
                  const Monitor& monitor);

/// The sign of p[axis] - q[axis].
int compare_coordinate(const PointTable& points, PointId p, PointId q, int axis, const Monitor& monitor);

/// Lexicographic comparison of coordinates; 0 iff the points are the same.
int compare_lexicographic(const PointTable& points, PointId p, PointId q, const Monitor& monitor);

/// A vector that matters up to a positive factor: a plane's normal, the direction of an edge, or
/// one that was computed. Holds doubles with a proven error, and exact integers once they are
/// asked for. Not to be shared between threads while it is asked.
class Direction {
 public:
  Direction() = default;

  /// The normal of an oriented plane.
  static Direction normal(const PlaneTable& planes, PlaneId plane);

  /// n_p x n_q for two planes that are not parallel: the direction of an svertex. The planes
  /// must outlive the result.
  static Direction cross(const PlaneTable& planes, PlaneId p, PlaneId q);

  /// An explicit non-zero vector.
  static Direction exact(const Integer& x, const Integer& y, const Integer& z);

  /// u x v. May be the zero vector.
  static Direction cross(const Direction& u, const Direction& v);

  [[nodiscard]] Direction negated() const;

  [[nodiscard]] bool is_zero() const;

  /// Integer components; computed at the first call.
  [[nodiscard]] const Integer3& integers() const&;
  /// Of a direction that ends with the expression: a copy, which may be bound to a reference.
  [[nodiscard]] Integer3 integers() &&;

  /// The planes that make a direction of an svertex; invalid for others.
  PlaneId p, q;

  /// Components scaled so that the largest is about 1; each within `error` of the truth.
  std::array<double, 3> approximate{};
  double error = 0;

 private:
  void set_approximation_from_integers();

  const PlaneTable* planes_ = nullptr;
  mutable bool known_ = false;
  bool negative_ = false;  // of a plane's normal, or of p x q
  mutable Integer3 integers_;
};

/// sign(u . v)
int sign_of_dot(const Direction& u, const Direction& v, const Monitor& monitor);

/// sign(u . (v x w))
int sign_of_determinant(const Direction& u, const Direction& v, const Direction& w, const Monitor& monitor);

/// True if u and v are positive multiples of each other.
bool same_direction(const Direction& u, const Direction& v, const Monitor& monitor);

/// The sign of a plane's form at a direction: which open half-sphere of the great circle of
/// `plane` the svertex lies in. By identity where `plane` made `direction`.
int side_of_circle(const PlaneTable& planes, PlaneId plane, const Direction& direction, const Monitor& monitor);

/// sign(n . (u x v)) for two directions on the great circle of `plane`: +1 if v comes within a
/// half-turn after u, counterclockwise as seen from the positive side.
int orientation_on_circle(const PlaneTable& planes, PlaneId plane, const Direction& u, const Direction& v,
                          const Monitor& monitor);

/// sign(d . (n1 x n2)) for two planes through the line of d: how the half-planes that leave d
/// along them are turned about d.
int orientation_around(const PlaneTable& planes, const Direction& d, PlaneId plane1, PlaneId plane2,
                       const Monitor& monitor);

}  // namespace nef
