// SPDX-License-Identifier: Apache-2.0
//
// The products whose roots are contact events (contact_events.h), in doubles, with bounds of their errors.
//
// Throughout, u = 2^-53, kImageError = 256 u, M is a matrix of a MotionCell and t one of its positions, coordinates are
// rounded to doubles, and `reach` is at least the sum of |x|_1 of both pieces' vertices and of the position.
#pragma once

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/motion_cell.h"

namespace nef::planner {

/// How far the image of a vertex x is above the plane with the unit normal n through p.
inline double vertex_product(const Vector3d& n, const Vector3d& p, const Eigen::Matrix3d& m, const Vector3d& t,
                             const Vector3d& x) {
  return n.dot(m * x + t - p);
}

/// How far a vertex x is above the image of the plane n y = at, n being a unit normal.
inline double face_product(const Vector3d& n, double at, const Eigen::Matrix3d& m, const Vector3d& t,
                           const Vector3d& x) {
  return (m * n).dot(x - t) - at;
}

/// The error of the two products above, beside the true ones of a normal of length 1. An image is off by kImageError of
/// `reach` in each coordinate, an image of a normal by sqrt(3) kImageError; normals are off by 2^-51 in each
/// coordinate, so together with some ten roundings a product is off by less than twice sqrt(3) kImageError reach.
inline double product_error(double reach) { return 4 * MotionCell::kImageError * reach + MotionCell::kVanished; }

/// An edge: a vertex and the way to the next one.
struct RoughEdge {
  Vector3d from;
  Vector3d along;
};

/// det(M e, g, M a + t - b) = g M (a x e) + (M e) (g x (t - b)) for the edges a + e and b + g: the volume that they
/// span, 0 if they are in one plane.
inline double edge_product(const RoughEdge& moving, const RoughEdge& fixed, const Eigen::Matrix3d& m,
                           const Vector3d& t) {
  return fixed.along.dot(m * moving.from.cross(moving.along)) +
         (m * moving.along).dot(fixed.along.cross(t - fixed.from));
}

/// The error of edge_product. With R for `reach` and |.| for the sum of a vector's coordinates: e and g are off by 4 u
/// R; a x e by 3 u R |e| + 4 u R^2; its image by 261 u R |e| + 6 u R^2 in each coordinate; so the first summand by 266
/// u R |e| |g| + 6 u R^2 (|e| + |g|). In the second M e is off by 256 u |e| + 6 u R in each coordinate, t - b by 9 u R,
/// g x (t - b) by 4 u R^2 + 11 u R |g|, so it is off by 277 u R |e| |g| + 6 u R^2 (|e| + |g|). Both, their sum and
/// products of two errors are below this.
inline double edge_product_error(double reach, const RoughEdge& moving, const RoughEdge& fixed) {
  const double e = moving.along.lpNorm<1>();
  const double g = fixed.along.lpNorm<1>();
  return MotionCell::kImageError * reach * (3 * e * g + reach * (0x1p-4 * (e + g) + 0x1p-40 * reach)) +
         MotionCell::kVanished;
}

}  // namespace nef::planner
