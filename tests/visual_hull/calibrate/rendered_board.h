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

  /// Whether a ray from a point meets it. Plain numbers: it is asked millions of times.
  [[nodiscard]] bool met(const std::array<double, 3>& from, const std::array<double, 3>& along) const {
    double pd = 0;
    double dd = 0;
    double pp = 0;
    for (int i = 0; i < 3; ++i) {
      const double p = (from[static_cast<std::size_t>(i)] - centre[i]) / axes[i];
      const double d = along[static_cast<std::size_t>(i)] / axes[i];
      pd += p * d;
      dd += d * d;
      pp += p * p;
    }
    return pd < 0 && pd * pd >= dd * (pp - 1);
  }
};

/// What lies where in a picture.
struct Photographed {
  cv::Mat picture;  ///< three channels of 8 bits
  cv::Mat mask;     ///< 255 where at least half of a pixel shows the object
};

/// Renders a board on a gray table, torn along its middle: its right half has moved up by so many millimetres.
class BoardStudio {
 public:
  explicit BoardStudio(const Board& board, std::optional<Egg> egg = {}, double torn = 0)
      : board_(board), sheet_(board_picture(board, kPixels)), egg_(std::move(egg)), torn_(torn) {}

  [[nodiscard]] Photographed photograph(const BoardCamera& camera, std::uint64_t seed, double noise = 3) const {
    const ImageSize size = *camera.lens.size;
    const cv::Mat rays = rays_of(camera.lens);
    Photographed result{cv::Mat(size.height, size.width, CV_8UC3), cv::Mat(size.height, size.width, CV_8U)};
    const Eigen::Vector3d centre = camera.centre();
    const std::array<double, 3> from{centre.x(), centre.y(), centre.z()};
    const Eigen::Matrix3d& r = camera.pose.rotation;
    const std::array<double, 9> turn{r(0, 0), r(1, 0), r(2, 0), r(0, 1), r(1, 1), r(2, 1), r(0, 2), r(1, 2), r(2, 2)};
    for (int y = 0; y < size.height; ++y) {
      const auto* const row = rays.ptr<double>(y);
      const auto* const below = rays.ptr<double>(y + 1);
      for (int x = 0; x < size.width; ++x) {
        std::array<double, 3> sum{};
        for (int k = 0; k < kSub * kSub; ++k) {
          const double dx = (k % kSub + 0.5) / kSub - 0.5;
          const int line = k / kSub;
          const double dy = (line + 0.5) / kSub - 0.5;
          const double u = row[2 * x] + dx * (row[2 * x + 2] - row[2 * x]) + dy * (below[2 * x] - row[2 * x]);
          const double v =
              row[2 * x + 1] + dx * (row[2 * x + 3] - row[2 * x + 1]) + dy * (below[2 * x + 1] - row[2 * x + 1]);
          const std::array<double, 3> along{turn[0] * u + turn[1] * v + turn[2], turn[3] * u + turn[4] * v + turn[5],
                                            turn[6] * u + turn[7] * v + turn[8]};
          const bool object = egg_ && egg_->met(from, along);
          const double gray = object ? 0 : seen_on_table(from, along);
          constexpr std::array<double, 3> kPaint{30, 40, 200};
          for (std::size_t c = 0; c < 3; ++c) sum[c] += object ? kPaint[c] : gray;
          if (k == 0) result.mask.ptr<std::uint8_t>(y)[x] = 0;
          if (object) result.mask.ptr<std::uint8_t>(y)[x] += 255 / (kSub * kSub);
        }
        for (std::size_t c = 0; c < 3; ++c) {
          result.picture.ptr<std::uint8_t>(y)[3 * x + static_cast<int>(c)] =
              static_cast<std::uint8_t>(sum[c] / (kSub * kSub));
        }
      }
    }
    result.mask = result.mask > 127;
    cv::RNG random(seed);
    cv::Mat grain(result.picture.size(), CV_16SC3);
    random.fill(grain, cv::RNG::NORMAL, 0, noise);
    cv::add(result.picture, grain, result.picture, cv::noArray(), CV_8U);
    return result;
  }

 private:
  static constexpr double kPixels = 6;  // a millimetre
  static constexpr int kSub = 2;

  // Where pixels look, with a row and a column more than there are.
  static cv::Mat rays_of(const Lens& lens) {
    std::vector<cv::Point2d> pixels;
    for (int y = 0; y <= lens.size->height; ++y) {
      for (int x = 0; x <= lens.size->width; ++x) pixels.emplace_back(x, y);
    }
    const cv::Mat k = (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
    cv::Mat rays;
    cv::undistortPoints(pixels, rays, k, lens.distortion);
    return rays.reshape(2, lens.size->height + 1);
  }

  [[nodiscard]] double seen_on_table(const std::array<double, 3>& from, const std::array<double, 3>& along) const {
    if (!(along[2] < 0)) return 90;
    const double t = -from[2] / along[2];
    const double at = from[0] + t * along[0];
    const double right = at + board_.width() / 2 + board_.square;
    const double down = board_.height() / 2 - from[1] - t * along[1] + board_.square + (at > 0 ? torn_ : 0);
    const int x = static_cast<int>(std::floor(right * kPixels));
    const int y = static_cast<int>(std::floor(down * kPixels));
    if (x < 0 || y < 0 || x >= sheet_.cols || y >= sheet_.rows) return 120;
    return 0.75 * sheet_.ptr<std::uint8_t>(y)[3 * x] + 25;
  }

  Board board_;
  cv::Mat sheet_;
  std::optional<Egg> egg_;
  double torn_;
};

}  // namespace nef::visual_hull::testing
