// SPDX-License-Identifier: Apache-2.0
//
// A camera that is refined: K zoomed about its principal point, turned and shifted, in doubles.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "apps/visual_hull/scene/camera.h"

namespace nef::visual_hull::refine {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

/// x = zoom(K) (R X + t): what is at hand is the camera as it stands now, changes are small motions in its own frame.
class MovingCamera {
 public:
  /// The camera of a matrix, which is taken apart into K (upper triangular, its last entry 1) and a rotation. A
  /// mirrored camera has a K of negative determinant.
  explicit MovingCamera(const Camera& camera);
  MovingCamera(const Eigen::Matrix3d& k, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);

  [[nodiscard]] const Eigen::Matrix3d& rotation() const { return r_; }
  [[nodiscard]] const Eigen::Vector3d& translation() const { return t_; }
  [[nodiscard]] Eigen::Vector3d centre() const { return -(r_.transpose() * t_); }
  /// Of a point in the camera's frame: its third coordinate.
  [[nodiscard]] Eigen::Vector3d inward(const Eigen::Vector3d& world) const { return r_ * world + t_; }
  [[nodiscard]] Eigen::Vector3d outward(const Eigen::Vector3d& own) const { return r_.transpose() * (own - t_); }

  /// Where a point of the camera's frame is seen; of positive depth.
  [[nodiscard]] Eigen::Vector2d seen(const Eigen::Vector3d& own) const;
  /// How that moves with the point: 2 x 3.
  [[nodiscard]] Eigen::Matrix<double, 2, 3> derivative(const Eigen::Vector3d& own) const;
  /// How that moves with the logarithm of the focal length.
  [[nodiscard]] Eigen::Vector2d by_zoom(const Eigen::Vector2d& seen) const { return seen - principal_; }

  /// The direction, of depth 1 in the camera's frame, in which an image point is seen.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& image) const;
  /// How that direction moves with the logarithm of the focal length.
  [[nodiscard]] Eigen::Vector3d ray_by_zoom(const Eigen::Vector2d& image) const;

  /// The mean focal length, in pixels.
  [[nodiscard]] double focal() const;

  /// Moves the object in the camera's frame: turned by the rotation vector step[0..2] about `pivot`, then shifted by
  /// step[3..5] times the pivot's depth. (The same as moving the camera the other way.)
  void move(const Vector6& step, const Eigen::Vector3d& pivot);
  /// Turns the object in space by a rotation about the point `about`.
  void turn_object(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& about);
  /// Moves space: X = scale * rotation * X' + shift, so that X' is seen where X was.
  void move_space(double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift);
  void set_pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
    r_ = rotation;
    t_ = translation;
  }
  /// Multiplies the focal length by exp(step).
  void zoom(double step) { zoom_ += step; }
  [[nodiscard]] double zoomed() const { return zoom_; }

  /// zoom(K) [R | t], with the scale of the matrix that it was made of.
  [[nodiscard]] Eigen::Matrix<double, 3, 4> matrix() const;

 private:
  Eigen::Matrix3d k_, inverse_;
  Eigen::Vector2d principal_;
  Eigen::Matrix3d r_;
  Eigen::Vector3d t_;
  double zoom_ = 0;   // logarithm
  double scale_ = 1;  // of the matrix
};

/// The matrix of the rotation by |v| about v.
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& v);

/// v x, as a matrix.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// A similarity of space: X = scale * rotation * X' + shift.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

/// The one after which (move_space) `moving` see points, best of all, where `fixed` see them. Least squares of image
/// points, by Gauss and Newton's method.
Similarity similarity(std::vector<MovingCamera> moving, const std::vector<MovingCamera>& fixed,
                      const std::vector<Eigen::Vector3d>& around);

/// The root of the mean squared distance between where two cameras see points.
double image_distance(const MovingCamera& a, const MovingCamera& b, const std::vector<Eigen::Vector3d>& points);

/// Corners and centres of the sides of a cube within the ball around a point: points to measure motions by.
std::vector<Eigen::Vector3d> ball_points(const Eigen::Vector3d& centre, double radius);

}  // namespace nef::visual_hull::refine
