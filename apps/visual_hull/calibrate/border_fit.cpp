// SPDX-License-Identifier: Apache-2.0
//
// Gauss and Newton. A view's own seven numbers (pose and spread) appear in its borders only, so they are eliminated
// view by view, and what is left are normal equations of the lens (Schur's complement) [Triggs et al. 2000].
#include "apps/visual_hull/calibrate/border_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "apps/visual_hull/calibrate/opencv_camera.h"
#include "apps/visual_hull/masks/separation.h"

namespace nef::visual_hull {
namespace {

constexpr int kFitSteps = 10;
constexpr double kTukey = 4.685;      // deviations, from which on a border does not count [Huber 1981]
constexpr double kLeastScale = 0.02;  // pixels
constexpr int kPoseNumbers = 6;
constexpr int kOwn = kPoseNumbers + 1;  // of a view: its pose, and how far black spreads
constexpr int kLensNumbers = 9;         // fx, fy, cx, cy, k1, k2, p1, p2, k3

using OwnMatrix = Eigen::Matrix<double, kOwn, kOwn>;
using OwnVector = Eigen::Matrix<double, kOwn, 1>;
using LensMatrix = Eigen::Matrix<double, kLensNumbers, kLensNumbers>;
using LensVector = Eigen::Matrix<double, kLensNumbers, 1>;

// Which of the lens's nine numbers move with each number that is free.
Eigen::MatrixXd free_numbers(const BoardLens& lens) {
  std::vector<Eigen::VectorXd> columns;
  const auto add = [&columns](std::initializer_list<int> rows) {
    columns.emplace_back(Eigen::VectorXd::Zero(kLensNumbers));
    for (const int row : rows) columns.back()[row] = 1;
  };
  if (lens.square_pixels) {
    add({0, 1});
  } else {
    add({0});
    add({1});
  }
  if (!lens.centred) {
    add({2});
    add({3});
  }
  for (int k = 0; k < lens.coefficients; ++k) add({4 + k});
  Eigen::MatrixXd result(kLensNumbers, columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = columns[i];
  return result;
}

void move(Lens& lens, const LensVector& by) {
  lens.fx += by[0];
  lens.fy += by[1];
  lens.cx += by[2];
  lens.cy += by[3];
  lens.distortion.resize(std::max<std::size_t>(lens.distortion.size(), kLensNumbers - 4));
  for (std::size_t k = 0; k + 4 < kLensNumbers; ++k) lens.distortion[k] += by[static_cast<Eigen::Index>(k + 4)];
}

/// How images of points move: two rows a point, with a view's own numbers (the last one does not move them) and with
/// those of the lens.
struct Derivatives {
  Eigen::Matrix<double, Eigen::Dynamic, kOwn> own;
  Eigen::Matrix<double, Eigen::Dynamic, kLensNumbers> lens;
};

Derivatives derivatives_of(const std::vector<cv::Point3d>& points, const Lens& lens, const OpenCvPose& pose) {
  const cv::Mat j = derivatives_of_seen(points, lens, pose);
  const auto rows = static_cast<Eigen::Index>(j.rows);
  Derivatives result{Eigen::Matrix<double, Eigen::Dynamic, kOwn>::Zero(rows, kOwn),
                     Eigen::Matrix<double, Eigen::Dynamic, kLensNumbers>::Zero(rows, kLensNumbers)};
  for (int i = 0; i < j.rows; ++i) {
    for (int k = 0; k < kPoseNumbers; ++k) result.own(i, k) = j.at<double>(i, k);
    for (int k = 0; k < std::min(kLensNumbers, j.cols - kPoseNumbers); ++k) {
      result.lens(i, k) = j.at<double>(i, kPoseNumbers + k);
    }
  }
  return result;
}

/// One view in the course of the fit.
class ViewFit {
 public:
  explicit ViewFit(const BorderView& view) : view_(view), pose_(OpenCvPose::of(view.pose)) {
    for (const SeenBorder& b : view.borders) points_.push_back(b.at);
  }

  // The equations at the current numbers, with weights from what borders are off by.
  void set_up(const Lens& lens) {
    const std::vector<double> off = distances(lens);
    const double least = kTukey * scale_of(off);
    const Derivatives d = derivatives_of(points_, lens, pose_);
    own_.setZero();
    own_slope_.setZero();
    by_lens_.setZero();
    lens_.setZero();
    lens_slope_.setZero();
    squares_ = 0;
    kept_ = 0;
    for (std::size_t i = 0; i < off.size(); ++i) {
      const double share = off[i] / least;
      if (std::abs(share) >= 1) continue;
      const double weight = (1 - share * share) * (1 - share * share);
      const auto row = 2 * static_cast<Eigen::Index>(i);
      const cv::Vec2d& n = view_.borders[i].direction;
      OwnVector own = (n[0] * d.own.row(row) + n[1] * d.own.row(row + 1)).transpose();
      own[kPoseNumbers] = 1;
      const LensVector of_lens = (n[0] * d.lens.row(row) + n[1] * d.lens.row(row + 1)).transpose();
      own_ += weight * own * own.transpose();
      own_slope_ += weight * off[i] * own;
      by_lens_ += weight * own * of_lens.transpose();
      lens_ += weight * of_lens * of_lens.transpose();
      lens_slope_ += weight * off[i] * of_lens;
      squares_ += weight * off[i] * off[i];
      ++kept_;
    }
    inverse_ = own_.inverse();
  }

  // What is left of the equations for the lens.
  void add_to(LensMatrix& matrix, LensVector& slope) const {
    matrix += lens_ - by_lens_.transpose() * inverse_ * by_lens_;
    slope += lens_slope_ - by_lens_.transpose() * (inverse_ * own_slope_);
  }

  // A step, with that of the lens.
  void step(const LensVector& lens) {
    const OwnVector by = -inverse_ * (own_slope_ + by_lens_ * lens);
    for (int k = 0; k < 3; ++k) {
      pose_.rotation.at<double>(k) += by[k];
      pose_.shift.at<double>(k) += by[3 + k];
    }
    spread_ += by[kPoseNumbers];
  }

  // What the images of points are off by, root mean square, if borders are off by `noise` and the lens has this inverse
  // matrix of its equations.
  [[nodiscard]] double off_px(const std::vector<cv::Point3d>& points, const Lens& lens, double noise,
                              const LensMatrix& lens_inverse) const {
    const Derivatives d = derivatives_of(points, lens, pose_);
    const Eigen::Matrix<double, Eigen::Dynamic, kLensNumbers> by_lens = d.lens - d.own * inverse_ * by_lens_;
    const double squares =
        (by_lens * lens_inverse * by_lens.transpose()).trace() + (d.own * inverse_ * d.own.transpose()).trace();
    return noise * std::sqrt(squares / static_cast<double>(points.size()));
  }

  [[nodiscard]] double squares() const { return squares_; }
  [[nodiscard]] std::size_t kept() const { return kept_; }
  [[nodiscard]] Pose pose() const { return pose_.pose(); }
  [[nodiscard]] const std::vector<cv::Point3d>& points() const { return points_; }

 private:
  // How far each border is predicted beyond where it is seen, towards white.
  [[nodiscard]] std::vector<double> distances(const Lens& lens) const {
    const std::vector<cv::Point2d> seen = seen_points(points_, lens, pose_);
    std::vector<double> result;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const cv::Point2d d = seen[i] - view_.borders[i].point;
      const cv::Vec2d& n = view_.borders[i].direction;
      result.push_back(n[0] * d.x + n[1] * d.y + spread_);
    }
    return result;
  }

  static double scale_of(const std::vector<double>& off) {
    std::vector<double> sizes;
    for (const double d : off) sizes.push_back(std::abs(d));
    return std::max(kLeastScale, 1.4826 * median_of(std::move(sizes)));
  }

  const BorderView& view_;
  OpenCvPose pose_;
  double spread_ = 0;  // of black over white, pixels
  std::vector<cv::Point3d> points_;
  OwnMatrix own_, inverse_;
  OwnVector own_slope_;
  Eigen::Matrix<double, kOwn, kLensNumbers> by_lens_;
  LensMatrix lens_;
  LensVector lens_slope_;
  double squares_ = 0;
  std::size_t kept_ = 0;
};

}  // namespace

void fit_borders(BoardLens& lens, std::span<BorderView> views, bool fit_the_lens) {
  const Eigen::MatrixXd free = free_numbers(lens);
  std::vector<ViewFit> fits;
  for (const BorderView& view : views) fits.emplace_back(view);
  LensMatrix inverse = LensMatrix::Zero();  // of the equations of the free numbers; zero for those that stay
  for (int step = 0; step <= kFitSteps; ++step) {
    LensMatrix matrix = LensMatrix::Zero();
    LensVector slope = LensVector::Zero();
    for (ViewFit& fit : fits) {
      fit.set_up(lens.lens);
      fit.add_to(matrix, slope);
    }
    if (fit_the_lens) inverse = free * (free.transpose() * matrix * free).inverse() * free.transpose();
    if (step == kFitSteps) break;
    const LensVector by = -inverse * slope;
    for (ViewFit& fit : fits) fit.step(by);
    move(lens.lens, by);
  }
  double squares = 0;
  double spare = fit_the_lens ? -static_cast<double>(free.cols()) : 0;
  for (const ViewFit& fit : fits) {
    squares += fit.squares();
    spare += static_cast<double>(fit.kept()) - kOwn;
  }
  const double noise = std::sqrt(squares / std::max(1.0, spare));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewFit& fit = fits[i];
    views[i].pose = fit.pose();
    views[i].kept = fit.kept();
    views[i].error_px = std::sqrt(fit.squares() / std::max<double>(1, static_cast<double>(fit.kept())));
    views[i].off_px = fit.off_px(things_on_board(fit.points()), lens.lens, noise, inverse);
  }
  if (fit_the_lens) lens.focal_share = noise * std::sqrt(inverse(0, 0)) / lens.lens.fx;
}

}  // namespace nef::visual_hull
