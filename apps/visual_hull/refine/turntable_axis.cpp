// SPDX-License-Identifier: Apache-2.0
//
// If R_i = R T_i and t_i = R (p - T_i p) + t for turns T_i about a line through p, then all R_0^T R_i leave the line's
// direction a as it is, R_i a is the same for all views, and so is R_i p + t_i, but for a multiple of that.
#include "apps/visual_hull/refine/turntable_axis.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace nef::visual_hull::refine {

std::optional<Axis> turntable_axis(const std::vector<MovingCamera>& cameras, double angle, double share) {
  constexpr std::size_t kFewest = 5;
  if (cameras.size() < kFewest) return std::nullopt;
  const auto n = static_cast<double>(cameras.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double widest = 0;
  for (const MovingCamera& camera : cameras) {
    const Eigen::Matrix3d turn = cameras[0].rotation().transpose() * camera.rotation();
    const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - turn;
    sum += rest.transpose() * rest;
    widest = std::max(widest, std::acos(std::clamp((turn.trace() - 1) / 2, -1.0, 1.0)));
  }
  if (widest < 0.5) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
  Axis axis;
  axis.direction = eigen.eigenvectors().col(0);
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();
  for (const MovingCamera& camera : cameras) seen += camera.rotation() * axis.direction / n;
  if (seen.norm() < 0.5) return std::nullopt;
  seen.normalize();
  for (const MovingCamera& camera : cameras) {
    if ((camera.rotation() * axis.direction - seen).norm() > angle) return std::nullopt;
  }
  // p across the axis: all R_i p + t_i agree with their mean, across `seen`.
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - seen * seen.transpose();
  Eigen::Matrix3d mean_r = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean_t = Eigen::Vector3d::Zero();
  for (const MovingCamera& camera : cameras) {
    mean_r += camera.rotation() / n;
    mean_t += camera.translation() / n;
  }
  Eigen::Matrix3d h = axis.direction * axis.direction.transpose();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const MovingCamera& camera : cameras) {
    const Eigen::Matrix3d a = across * (camera.rotation() - mean_r);
    h += a.transpose() * a;
    g -= a.transpose() * across * (camera.translation() - mean_t);
  }
  axis.point = h.ldlt().solve(g);
  for (const MovingCamera& camera : cameras) {
    const Eigen::Vector3d rest = across * ((camera.rotation() - mean_r) * axis.point + camera.translation() - mean_t);
    const double distance = (camera.centre() - axis.point).norm();
    if (rest.norm() > share * distance) return std::nullopt;
  }
  return axis;
}

namespace {

// The rotation nearest to a matrix.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

// The angle of the turn about the axis that is nearest to a rotation.
double angle_about(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d across = axis.unitOrthogonal();
  const Eigen::Vector3d third = axis.cross(across);
  const double s = third.dot(rotation * across) - across.dot(rotation * third);
  const double c = across.dot(rotation * across) + third.dot(rotation * third);
  return std::atan2(s, c);
}

// Angles that grow by equal steps, as near to those given as can be.
std::optional<std::vector<double>> evened(std::vector<double> angles) {
  constexpr double kLargest = 2 * M_PI / 180;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double before = angles[i - 1];
    angles[i] -= 2 * M_PI * std::round((angles[i] - before) / (2 * M_PI));
  }
  const double middle = (static_cast<double>(angles.size()) - 1) / 2;
  double mean = 0;
  double up = 0;
  double across = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    mean += angles[i] / static_cast<double>(angles.size());
    up += x * angles[i];
    across += x * x;
  }
  double step = up / across;
  const double whole = 2 * M_PI / static_cast<double>(angles.size());  // of a full turn
  if (std::abs(std::abs(step) - whole) < kLargest / static_cast<double>(angles.size()))
    step = std::copysign(whole, step);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double even = mean + (static_cast<double>(i) - middle) * step;
    if (std::abs(angles[i] - even) > kLargest) return std::nullopt;
    angles[i] = even;
  }
  return angles;
}

}  // namespace

std::optional<std::vector<MovingCamera>> as_turntable(const std::vector<MovingCamera>& cameras, const Axis& axis,
                                                      bool even) {
  const Eigen::Vector3d& a = axis.direction;
  std::vector<double> angles;
  for (const MovingCamera& camera : cameras) {
    angles.push_back(angle_about(cameras[0].rotation().transpose() * camera.rotation(), a));
  }
  if (even) {
    const std::optional<std::vector<double>> steps = evened(angles);
    if (!steps) return std::nullopt;
    angles = *steps;
  }
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    turn += cameras[i].rotation() * rotation_by(-angles[i] * a);
    shift += cameras[i].inward(axis.point) / static_cast<double>(cameras.size());
  }
  turn = nearest_rotation(turn);
  std::vector<MovingCamera> result = cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Eigen::Matrix3d r = turn * rotation_by(angles[i] * a);
    result[i].set_pose(r, shift - r * axis.point);
  }
  return result;
}

}  // namespace nef::visual_hull::refine
