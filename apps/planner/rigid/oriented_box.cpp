// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/oriented_box.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace nef::planner {
namespace {

bool are_orthonormal(const Eigen::Matrix3d& axes) {
  // Rounding takes 4 * 2^-53 at most from the comparison.
  const Eigen::Matrix3d skew = axes.transpose() * axes - Eigen::Matrix3d::Identity();
  return (skew.array().abs() <= OrientedBox::kSkew / 2).all();  // false if there is a NaN
}

// A vector across a unit vector.
Vector3d across(const Vector3d& n) {
  Eigen::Index smallest = 0;
  n.cwiseAbs().minCoeff(&smallest);
  return n.cross(Vector3d::Unit(smallest)).normalized();
}

}  // namespace

// With u = 2^-53, R the largest coordinate of a point and D the largest |p - c|_1 of one, x = A^-1 (p - c) is what
// |x_k| <= half_k must hold for. A^T (p - c) is off from it by 3 kSkew D, since A^-1 = (A^T A)^-1 A^T; the computed
// one by 2 u R for the point and the difference and by 4 u D. As D <= 6 R, all of it, and the roundings of
// the ends and the halves, is less than 2^-41 R.
OrientedBox box_around(const std::vector<Vector3d>& points, const Eigen::Matrix3d& axes) {
  OrientedBox box;
  if (are_orthonormal(axes)) box.axes = axes;
  Vector3d low = Vector3d::Constant(HUGE_VAL);
  Vector3d high = Vector3d::Constant(-HUGE_VAL);
  double largest = 0;
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  }
  const Vector3d middle = low / 2 + high / 2;
  low.setConstant(HUGE_VAL);
  high.setConstant(-HUGE_VAL);
  for (const Vector3d& p : points) {
    const Vector3d x = box.axes.transpose() * (p - middle);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  box.centre = middle + box.axes * ((low + high) / 2);
  // The centre is rounded, too: halves are measured from it.
  for (const Vector3d& p : points) {
    const Vector3d x = box.axes.transpose() * (p - box.centre);
    box.half = box.half.cwiseMax(x.cwiseAbs());
  }
  box.half.array() += 0x1p-41 * largest;
  return box;
}

Eigen::Matrix3d axes_of_scatter(const std::vector<Vector3d>& points) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) scatter += (p - middle) * (p - middle).transpose();
  if (!scatter.allFinite()) return Eigen::Matrix3d::Identity();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors();
}

Eigen::Matrix3d axes_of_polygon(const std::vector<Vector3d>& points, const Vector3d& normal) {
  Vector3d longest = Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d way = points[(i + 1) % points.size()] - points[i];
    if (way.norm() > longest.norm()) longest = way;
  }
  const Vector3d second = normal.cross(longest);
  Eigen::Matrix3d axes;
  axes.col(0) = normal;
  axes.col(1) = second.norm() > 0 ? Vector3d(second.normalized()) : across(normal);
  axes.col(2) = normal.cross(axes.col(1)).normalized();
  return axes;
}

}  // namespace nef::planner
