// SPDX-License-Identifier: Apache-2.0
//
// Photographs of a board with an ellipsoid on it, by cameras of which everything is known: lens, pose, noise.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "apps/visual_hull/calibrate/board_sheet.h"
#include "apps/visual_hull/scene/pose.h"

namespace nef::visual_hull::testing {

/// A camera that photographs.
struct BoardCamera {
  Lens lens;
  Pose pose;

  [[nodiscard]] Eigen::Vector3d centre() const { return -pose.rotation.transpose() * pose.translation; }
};

inline Lens usual_lens(double focal = 760, double dx = 0, double dy = 0) {
  const ImageSize size{640, 480};
  return {focal, focal, (size.width - 1) / 2.0 + dx, (size.height - 1) / 2.0 + dy, {-0.12, 0.04, 0, 0, 0}, size};
}

/// A camera at a place (millimetres, the board's frame) that looks at another one, upright but for a roll (radians).
inline Pose looking(const Eigen::Vector3d& from, const Eigen::Vector3d& at, double roll = 0) {
  const Eigen::Vector3d ahead = (at - from).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose pose;
  pose.rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  pose.rotation = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() * pose.rotation;
  pose.translation = -pose.rotation * from;
  return pose;
}

/// A turntable: the camera at 35 degrees of elevation, the board turned by a full turn in equal steps.
inline std::vector<BoardCamera> turntable_before(const Lens& lens, int count, double distance = 520) {
  std::vector<BoardCamera> cameras;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * M_PI * i / count;
    const double e = 35 * M_PI / 180;
    const Eigen::Vector3d from =
        distance * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    cameras.push_back({lens, looking(from, {3, -2, 10})});
  }
  return cameras;
}

/// An object with half-axes along those of the board.
struct Egg {
  Eigen::Vector3d centre{0, 0, 32};
  Eigen::Vector3d axes{24, 18, 30};
};

/// What lies where in a picture.
struct Photographed {
  cv::Mat picture;  ///< three channels of 8 bits
  cv::Mat mask;     ///< 255 where the middle of a pixel shows the object
};

/// Renders a board on a gray table, torn along its middle: its right half has moved up by so many millimetres. All
/// work is done by OpenCV on whole images, so it is quick in builds with sanitizers, too.
class BoardStudio {
 public:
  explicit BoardStudio(const Board& board, std::optional<Egg> egg = {}, double torn = 0)
      : board_(board), egg_(std::move(egg)), torn_(torn) {
    cv::cvtColor(board_picture(board, kPixels), sheet_, cv::COLOR_BGR2GRAY);
    sheet_.convertTo(sheet_, -1, 0.75, 25);
  }

  [[nodiscard]] Photographed photograph(const BoardCamera& camera, std::uint64_t seed, double noise = 3) const {
    const cv::Mat middles = rays_of(camera.lens);
    cv::Mat rays;  // four of each pixel
    cv::resize(middles, rays, {}, 2, 2, cv::INTER_LINEAR);
    const Eigen::Vector3d from = camera.centre();
    const Eigen::Matrix3d turn = camera.pose.rotation.transpose();
    cv::Mat picture;
    cv::cvtColor(table(rays, from, turn), picture, cv::COLOR_GRAY2BGR);
    Photographed result;
    result.mask = cv::Mat(middles.size(), CV_8U, cv::Scalar(0));
    if (egg_) {
      result.mask = object_in(middles, from, turn);
      picture.setTo(cv::Scalar(30, 40, 200), object_in(rays, from, turn));
    }
    cv::resize(picture, result.picture, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::RNG random(seed);
    cv::Mat grain(result.picture.size(), CV_16SC3);
    random.fill(grain, cv::RNG::NORMAL, 0, noise);
    cv::add(result.picture, grain, result.picture, cv::noArray(), CV_8U);
    return result;
  }

 private:
  static constexpr double kPixels = 6;  // a millimetre
  static constexpr double kTable = 120;

  // Where the middles of pixels look: (u, v) of directions (u, v, 1) of the camera's frame.
  static cv::Mat rays_of(const Lens& lens) {
    std::vector<cv::Point2d> pixels;
    for (int y = 0; y < lens.size->height; ++y) {
      for (int x = 0; x < lens.size->width; ++x) pixels.emplace_back(x, y);
    }
    const cv::Mat k = (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
    cv::Mat rays;
    cv::undistortPoints(pixels, rays, k, lens.distortion);
    rays.reshape(2, lens.size->height).convertTo(rays, CV_32F);
    return rays;
  }

  // The table and the sheet on it. A ray meets the plane at a point whose coordinates are fractions of linear functions
  // of (u, v, 1).
  [[nodiscard]] cv::Mat table(const cv::Mat& rays, const Eigen::Vector3d& from, const Eigen::Matrix3d& turn) const {
    const Eigen::RowVector3d depth = turn.row(2);
    const Eigen::RowVector3d x = from.x() * depth - from.z() * turn.row(0);
    const Eigen::RowVector3d y = from.y() * depth - from.z() * turn.row(1);
    Eigen::Matrix3d h;
    h << kPixels * (x + (board_.width() / 2 + board_.square) * depth) - 0.5 * depth,
        kPixels * ((board_.height() / 2 + board_.square) * depth - y) - 0.5 * depth, depth;
    const cv::Mat homography =
        (cv::Mat_<double>(3, 3) << h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1), h(2, 2));
    cv::Mat places;
    cv::perspectiveTransform(rays, places, homography);
    if (torn_ != 0) {
      std::array<cv::Mat, 2> parts;
      cv::split(places, parts);
      cv::add(parts[1], cv::Scalar(torn_ * kPixels), parts[1],
              parts[0] > kPixels * (board_.width() / 2 + board_.square) - 0.5);
      cv::merge(parts, places);
    }
    cv::Mat seen;
    cv::remap(sheet_, seen, places, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, cv::Scalar(kTable));
    return seen;
  }

  // 255 where a ray meets the object: where a quadratic form of (u, v, 1) is not negative.
  [[nodiscard]] cv::Mat object_in(const cv::Mat& rays, const Eigen::Vector3d& from, const Eigen::Matrix3d& turn) const {
    const Eigen::Vector3d p = (from - egg_->centre).cwiseQuotient(egg_->axes);
    const Eigen::Matrix3d along = egg_->axes.cwiseInverse().asDiagonal() * turn;
    const Eigen::Matrix3d q =
        along.transpose() * (p * p.transpose() - (p.squaredNorm() - 1) * Eigen::Matrix3d::Identity()) * along;
    std::array<cv::Mat, 2> parts;
    cv::split(rays, parts);
    const auto& [u, v] = parts;
    const cv::Mat form =
        u.mul(q(0, 0) * u + 2 * q(0, 1) * v + 2 * q(0, 2)) + v.mul(q(1, 1) * v + 2 * q(1, 2)) + q(2, 2);
    return form >= 0;
  }

  Board board_;
  cv::Mat sheet_;
  std::optional<Egg> egg_;
  double torn_;
};

}  // namespace nef::visual_hull::testing
