// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/pose.h"

#include <Eigen/LU>
#include <algorithm>

#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"

namespace nef::visual_hull {

Eigen::Matrix3d Lens::matrix() const {
  Eigen::Matrix3d k;
  k << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  return k;
}

View make_view(const std::string& name, const Lens& lens, const Pose& pose) {
  Eigen::Matrix<double, 3, 4> motion;
  motion << pose.rotation, pose.translation;
  View view = make_view(name, Eigen::Matrix<double, 3, 4>(lens.matrix() * motion));
  view.size = lens.size;
  const auto& c = lens.distortion;
  if (std::any_of(c.begin(), c.end(), [](double k) { return k != 0; })) {
    view.distortion.coefficients = c;
    const Eigen::Matrix3d k = lens.matrix();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        view.distortion.intrinsics[i][j] =
            nef::exact_rational(k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
  }
  return view;
}

View make_view(const std::string& name, const Eigen::Matrix<double, 3, 4>& matrix) {
  if (!matrix.allFinite()) throw nef::InputError("view " + name + ": a number of the camera is not finite");
  Matrix34 exact;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      check_size(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), "view " + name + ", its matrix");
      exact[i][j] = nef::exact_rational(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  View view;
  view.name = name;
  view.camera = Camera(name, exact);
  return view;
}

Pose from_opengl(const Eigen::Matrix4d& camera_to_world) {
  // Turned about x by half a turn, to y down and z ahead; then the other way round.
  Eigen::Matrix3d axes = camera_to_world.topLeftCorner<3, 3>();
  axes.col(1) *= -1;
  axes.col(2) *= -1;
  Pose pose;
  pose.rotation = axes.inverse();
  pose.translation = -pose.rotation * camera_to_world.topRightCorner<3, 1>();
  return pose;
}

Eigen::Matrix<double, 3, 4> to_doubles(const Camera& camera) {
  Eigen::Matrix<double, 3, 4> m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = nef::nearest_double(camera.matrix()[i][j]);
    }
  }
  return m;
}

}  // namespace nef::visual_hull
