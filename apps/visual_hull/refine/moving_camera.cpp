// SPDX-License-Identifier: Apache-2.0
//
// A matrix is taken apart by a QR decomposition; the zoom is a factor about the principal point, in front of K; motions
// of the camera's frame multiply from the left, those of space from the right.
#include "apps/visual_hull/refine/moving_camera.h"

#include <Eigen/Dense>
#include <cmath>

#include "apps/visual_hull/scene/pose.h"

namespace nef::visual_hull::refine {

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle < 1e-300) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

MovingCamera::MovingCamera(const Eigen::Matrix3d& k, const Eigen::Matrix3d& rotation,
                           const Eigen::Vector3d& translation)
    : k_(k), r_(rotation), t_(translation) {
  k_ /= k_(2, 2);
  inverse_ = k_.inverse();
  principal_ = k_.col(2).head<2>();
}

MovingCamera::MovingCamera(const Camera& camera) {
  require_pinhole(camera, "refining");
  const Eigen::Matrix<double, 3, 4> p = to_doubles(camera);
  Eigen::Matrix3d left = p.leftCols<3>();
  // M = K R from the QR decomposition of M turned over: with J the reversal of rows, (J M)^T = Q U gives M = (J U^T J)
  // (J Q^T). The last row of M is a positive multiple of that of R, since depths are positive in front.
  const bool mirrored = left.determinant() < 0;
  Eigen::Vector3d flip(1, mirrored ? -1 : 1, 1);
  const Eigen::Matrix3d reversed = (flip.asDiagonal() * left).colwise().reverse().transpose();
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr(reversed);
  Eigen::Matrix3d q = qr.householderQ();
  Eigen::Matrix3d u = qr.matrixQR().triangularView<Eigen::Upper>();
  Eigen::Matrix3d k = u.transpose().colwise().reverse().rowwise().reverse();
  Eigen::Matrix3d r = q.transpose().colwise().reverse();
  for (int i = 0; i < 3; ++i) {
    if (k(i, i) >= 0) continue;
    k.col(i) *= -1;
    r.row(i) *= -1;
  }
  scale_ = k(2, 2);
  k_ = flip.asDiagonal() * k / scale_;
  inverse_ = k_.inverse();
  principal_ = k_.col(2).head<2>();
  r_ = r;
  t_ = inverse_ * p.col(3) / scale_;
}

Eigen::Vector2d MovingCamera::seen(const Eigen::Vector3d& own) const {
  const Eigen::Vector3d x = k_ * own;
  return principal_ + std::exp(zoom_) * (x.head<2>() / x.z() - principal_);
}

Eigen::Matrix<double, 2, 3> MovingCamera::derivative(const Eigen::Vector3d& own) const {
  const Eigen::Vector3d x = k_ * own;
  return std::exp(zoom_) / x.z() * (k_.topRows<2>() - x.head<2>() / x.z() * k_.row(2));
}

Eigen::Vector3d MovingCamera::ray(const Eigen::Vector2d& image) const {
  const Eigen::Vector2d plain = principal_ + std::exp(-zoom_) * (image - principal_);
  return inverse_ * plain.homogeneous();
}

Eigen::Vector3d MovingCamera::ray_by_zoom(const Eigen::Vector2d& image) const {
  const Eigen::Vector2d plain = std::exp(-zoom_) * (image - principal_);
  return -(inverse_.leftCols<2>() * plain);
}

double MovingCamera::focal() const {
  return std::exp(zoom_) * std::sqrt(std::abs(k_.topLeftCorner<2, 2>().determinant()));
}

void MovingCamera::move(const Vector6& step, const Eigen::Vector3d& pivot) {
  const Eigen::Matrix3d turn = rotation_by(step.head<3>());
  r_ = turn * r_;
  t_ = turn * (t_ - pivot) + pivot + pivot.z() * step.tail<3>();
}

void MovingCamera::turn_object(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& about) {
  t_ += r_ * (about - rotation * about);
  r_ = r_ * rotation;
}

void MovingCamera::move_space(double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift) {
  t_ = (r_ * shift + t_) / scale;
  r_ = r_ * rotation;
}

Eigen::Matrix<double, 3, 4> MovingCamera::matrix() const {
  Eigen::Matrix3d k = k_;
  const double z = std::exp(zoom_);
  k.topRows<2>() = z * k_.topRows<2>() + (1 - z) * principal_ * k_.row(2);
  Eigen::Matrix<double, 3, 4> pose;
  pose << r_, t_;
  return scale_ * k * pose;
}

Similarity similarity(std::vector<MovingCamera> moving, const std::vector<MovingCamera>& fixed,
                      const std::vector<Eigen::Vector3d>& around) {
  Similarity result;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : around) middle += p / static_cast<double>(around.size());
  double size = 0;
  for (const Eigen::Vector3d& p : around) size = std::max(size, (p - middle).norm());
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 7, 7> h = Eigen::Matrix<double, 7, 7>::Zero();
    Eigen::Matrix<double, 7, 1> g = Eigen::Matrix<double, 7, 1>::Zero();
    for (std::size_t i = 0; i < moving.size(); ++i) {
      for (const Eigen::Vector3d& p : around) {
        const Eigen::Vector3d own = moving[i].inward(p);
        const Eigen::Vector3d there = fixed[i].inward(p);
        if (!(own.z() > 0) || !(there.z() > 0)) continue;
        const Eigen::Matrix<double, 2, 3> d = moving[i].derivative(own) * moving[i].rotation();
        Eigen::Matrix<double, 2, 7> j;  // turn, shift / size, logarithm of the scale: about the middle
        j << -d * cross_matrix(p - middle), d * size, d * (p - middle);
        const Eigen::Vector2d r = moving[i].seen(own) - fixed[i].seen(there);
        h += j.transpose() * j;
        g += j.transpose() * r;
      }
    }
    h.diagonal() *= 1 + 1e-12;
    h.diagonal().array() += 1e-12 * h.diagonal().maxCoeff();
    const Eigen::Matrix<double, 7, 1> step = -h.ldlt().solve(g);
    const double scale = std::exp(step[6]);
    const Eigen::Matrix3d turn = rotation_by(step.head<3>());
    const Eigen::Vector3d shift = middle - scale * (turn * middle) + size * step.segment<3>(3);
    for (MovingCamera& camera : moving) camera.move_space(scale, turn, shift);
    result.shift += result.scale * (result.rotation * shift);
    result.rotation = result.rotation * turn;
    result.scale *= scale;
    if (step.norm() < 1e-12) break;
  }
  return result;
}

double image_distance(const MovingCamera& a, const MovingCamera& b, const std::vector<Eigen::Vector3d>& points) {
  double sum = 0;
  for (const Eigen::Vector3d& p : points) sum += (a.seen(a.inward(p)) - b.seen(b.inward(p))).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

std::vector<Eigen::Vector3d> ball_points(const Eigen::Vector3d& centre, double radius) {
  std::vector<Eigen::Vector3d> points;
  const double side = radius / std::sqrt(3.0);
  for (int k = 0; k < 8; ++k) {
    points.emplace_back(centre +
                        side * Eigen::Vector3d((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1));
  }
  return points;
}

}  // namespace nef::visual_hull::refine
