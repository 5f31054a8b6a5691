// SPDX-License-Identifier: Apache-2.0
//
// The smallest model is fitted from several focal lengths, since photographs of one tilt leave little to start from;
// each larger one begins where the last one that was taken ended. What OpenCV reports as standard deviations are those
// of the normal equations at the end, so parameters that the boards leave open have large ones.
#include "apps/visual_hull/calibrate/board_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "apps/visual_hull/calibrate/opencv_camera.h"
#include "apps/visual_hull/masks/separation.h"

namespace nef::visual_hull {
namespace {

constexpr double kSignificant = 10;     // F, for each parameter
constexpr double kCentreShare = 0.005;  // of the longer side: what a principal point may be off by
constexpr double kAspectShare = 0.005;  // of a focal length
constexpr double kAlike = 1.5;          // times the error of the better pose
constexpr double kMostAlike = 0.05;     // pixels, where both are small
constexpr double kOtherTilt = 0.03;     // radians between poses that differ
constexpr double kFarOff = 3;           // times the median distance of corners
constexpr double kLeastFarOff = 0.2;    // pixels
constexpr std::size_t kFewestKept = 8;  // corners

/// A model: what is held, and how many parameters are free.
struct LensChoice {
  int flags;
  int free;
  bool square_pixels;
  bool centred;
  int coefficients;
};

constexpr int kNoTangent = cv::CALIB_ZERO_TANGENT_DIST;
constexpr std::array<LensChoice, 4> kLensChoices{{
    {cv::CALIB_FIX_PRINCIPAL_POINT | cv::CALIB_FIX_ASPECT_RATIO | kNoTangent | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3, 2,
     true, true, 1},
    {cv::CALIB_FIX_PRINCIPAL_POINT | cv::CALIB_FIX_ASPECT_RATIO | kNoTangent | cv::CALIB_FIX_K3, 3, true, true, 2},
    {cv::CALIB_FIX_ASPECT_RATIO | kNoTangent | cv::CALIB_FIX_K3, 5, true, false, 2},
    {0, 9, false, false, 5},
}};

/// A fit of one model.
struct LensFit {
  cv::Mat k = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion = cv::Mat::zeros(1, 5, CV_64F);
  cv::Mat deviations;
  double error = HUGE_VAL;

  [[nodiscard]] double deviation(int parameter) const { return deviations.at<double>(parameter); }
};

class LensFitting {
 public:
  LensFitting(std::span<const SeenBoard* const> views, const ImageSize& size) : size_(size.width, size.height) {
    for (const SeenBoard* view : views) {
      corners_.emplace_back(view->corners.begin(), view->corners.end());
      points_.emplace_back(view->points.begin(), view->points.end());
      count_ += view->points.size();
    }
  }

  [[nodiscard]] LensFit fitted(const LensChoice& model, const LensFit& start) const {
    LensFit fit{start.k.clone(), start.distortion.clone(), {}, HUGE_VAL};
    try {
      fit.error =
          cv::calibrateCamera(corners_, points_, size_, fit.k, fit.distortion, cv::noArray(), cv::noArray(),
                              fit.deviations, cv::noArray(), cv::noArray(), model.flags | cv::CALIB_USE_INTRINSIC_GUESS,
                              {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-10});
    } catch (const cv::Exception&) {  // a step to nowhere: this start is none
    }
    const double f = fit.k.at<double>(0, 0);
    if (!std::isfinite(fit.error) || !std::isfinite(f) || f <= 0) fit.error = HUGE_VAL;
    return fit;
  }

  [[nodiscard]] LensFit start(double focal) const {
    LensFit fit;
    fit.k.at<double>(0, 0) = fit.k.at<double>(1, 1) = focal;
    fit.k.at<double>(0, 2) = (size_.width - 1) / 2.0;
    fit.k.at<double>(1, 2) = (size_.height - 1) / 2.0;
    return fit;
  }

  // Whether a larger model explains more than chance would.
  [[nodiscard]] bool significant(const LensFit& small, const LensChoice& small_model, const LensFit& large,
                                 const LensChoice& large_model) const {
    const double n = static_cast<double>(count_);
    const double spare = 2 * n - 6 * static_cast<double>(points_.size()) - large_model.free;
    if (!(spare > 0) || !std::isfinite(large.error)) return false;
    const double rest = n * large.error * large.error;
    const double gain = n * small.error * small.error - rest;
    return gain / (large_model.free - small_model.free) > kSignificant * rest / spare;
  }

  // Whether the boards say where the parameters of a model are.
  [[nodiscard]] bool determined(const LensFit& fit, const LensChoice& model) const {
    const double longer = std::max(size_.width, size_.height);
    const bool centre = model.centred || std::max(fit.deviation(2), fit.deviation(3)) < kCentreShare * longer;
    const bool aspect = (model.flags & cv::CALIB_FIX_ASPECT_RATIO) != 0 ||
                        std::max(fit.deviation(0), fit.deviation(1)) < kAspectShare * fit.k.at<double>(0, 0);
    return centre && aspect;
  }

  [[nodiscard]] cv::Size size() const { return size_; }

 private:
  cv::Size size_;
  std::size_t count_ = 0;
  std::vector<std::vector<cv::Point3f>> corners_;  // OpenCV wants floats: a millionth of the board
  std::vector<std::vector<cv::Point2f>> points_;
};

// The camera of one view: poses and how well they explain a board.
class BoardCamera {
 public:
  explicit BoardCamera(const Lens& lens) : lens_(lens), k_(opencv_matrix(lens)) {}

  [[nodiscard]] std::vector<OpenCvPose> poses(const SeenBoard& view) const {
    std::vector<cv::Mat> rotations;
    std::vector<cv::Mat> shifts;
    try {
      cv::solvePnPGeneric(view.corners, view.points, k_, lens_.distortion, rotations, shifts, false, cv::SOLVEPNP_IPPE);
    } catch (const cv::Exception&) {  // the corners lie such that there is none
      return {};
    }
    std::vector<OpenCvPose> result;
    for (std::size_t i = 0; i < rotations.size(); ++i) result.push_back({rotations[i], shifts[i]});
    return result;
  }

  // By least squares.
  void fit(const SeenBoard& view, OpenCvPose& pose) const {
    cv::solvePnPRefineLM(view.corners, view.points, k_, lens_.distortion, pose.rotation, pose.shift);
  }

  // Of each corner, from where the pose has it, in pixels.
  [[nodiscard]] std::vector<double> distances(const SeenBoard& view, const OpenCvPose& pose) const {
    const std::vector<cv::Point2d> seen = seen_points(view.corners, lens_, pose);
    std::vector<double> result;
    for (std::size_t i = 0; i < seen.size(); ++i) result.push_back(cv::norm(seen[i] - view.points[i]));
    return result;
  }

  // What a pose that was fitted to a board makes the image of things on it be off by: its covariance is s^2 (J^T J)^-1,
  // with s of the corners' distances and J how their images move with the pose.
  [[nodiscard]] double off_px(const SeenBoard& view, const OpenCvPose& pose) const {
    const double spare = 2 * static_cast<double>(view.points.size()) - 6;
    if (!(spare > 0)) return HUGE_VAL;
    double squares = 0;
    for (const double d : distances(view, pose)) squares += d * d;
    const cv::Mat j = derivatives_of_seen(view.corners, lens_, pose).colRange(0, 6);
    const cv::Mat off = derivatives_of_seen(things_on_board(view.corners), lens_, pose).colRange(0, 6);
    const cv::Mat covariance = (squares / spare) * cv::Mat(j.t() * j).inv(cv::DECOMP_SVD);
    return std::sqrt(cv::trace(off * covariance * off.t())[0] / (off.rows / 2.0));
  }

  [[nodiscard]] double error(const SeenBoard& view, const OpenCvPose& pose) const {
    double sum = 0;
    for (const double d : distances(view, pose)) sum += d * d;
    return std::sqrt(sum / static_cast<double>(view.points.size()));
  }

 private:
  Lens lens_;
  cv::Mat k_;
};

// Without the corners that are off by far more than the others: the object, its outline or the border of a shadow lies
// beside them. They go one by one, since each draws the pose to itself. If many do, something else is wrong, and all
// stay.
SeenBoard trusted_corners(const SeenBoard& view, const BoardCamera& camera, OpenCvPose& pose) {
  const std::size_t fewest = std::max(kFewestKept, view.points.size() - view.points.size() / 4);
  SeenBoard kept = view;
  OpenCvPose fitted{pose.rotation.clone(), pose.shift.clone()};
  while (true) {
    const std::vector<double> off = camera.distances(kept, fitted);
    const auto worst = std::max_element(off.begin(), off.end()) - off.begin();
    if (off[static_cast<std::size_t>(worst)] <= std::max(kLeastFarOff, kFarOff * median_of(off))) break;
    if (kept.points.size() <= fewest) return view;
    kept.corners.erase(kept.corners.begin() + worst);
    kept.points.erase(kept.points.begin() + worst);
    camera.fit(kept, fitted);
  }
  pose = fitted;
  return kept;
}

// The pose that explains the corners best.
std::optional<BoardPose> best_pose(const SeenBoard& view, const BoardCamera& camera) {
  std::vector<BoardPose> poses;
  for (OpenCvPose& pose : camera.poses(view)) {
    camera.fit(view, pose);
    const SeenBoard trusted = trusted_corners(view, camera, pose);
    BoardPose found{pose.pose(), camera.error(trusted, pose), trusted.points.size(), camera.off_px(trusted, pose),
                    false};
    if (std::isfinite(found.error_px) && found.pose.translation.z() > 0) poses.push_back(found);
  }
  if (poses.empty()) return std::nullopt;
  std::sort(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.error_px < b.error_px; });
  BoardPose& best = poses.front();
  for (const BoardPose& other : poses) {
    const double cosine = ((best.pose.rotation.transpose() * other.pose.rotation).trace() - 1) / 2;
    const bool differs = cosine < std::cos(kOtherTilt);
    if (differs && other.error_px < kAlike * best.error_px + kMostAlike) best.ambiguous = true;
  }
  return best;
}

}  // namespace

BoardLens fit_lens(std::span<const SeenBoard* const> views, const ImageSize& size) {
  const LensFitting fitting(views, size);
  LensFit best;
  for (const double focal : {0.8, 1.2, 2.5, 6.0}) {
    LensFit fit = fitting.fitted(kLensChoices[0], fitting.start(focal * std::max(size.width, size.height)));
    if (fit.error < best.error) best = std::move(fit);
  }
  BoardLens result;
  if (!std::isfinite(best.error)) {
    result.error_px = HUGE_VAL;
    return result;
  }
  const LensChoice* taken = kLensChoices.data();
  for (const LensChoice& model : std::span(kLensChoices).subspan(1)) {
    LensFit fit = fitting.fitted(model, best);
    if (!fitting.significant(best, *taken, fit, model) || !fitting.determined(fit, model)) continue;
    best = std::move(fit);
    taken = &model;
  }
  result.error_px = best.error;
  result.square_pixels = taken->square_pixels;
  result.centred = taken->centred;
  result.coefficients = taken->coefficients;
  Lens& lens = result.lens;
  lens.fx = best.k.at<double>(0, 0);
  lens.fy = best.k.at<double>(1, 1);
  lens.cx = best.k.at<double>(0, 2);
  lens.cy = best.k.at<double>(1, 2);
  lens.distortion.assign(best.distortion.begin<double>(), best.distortion.end<double>());
  lens.size = size;
  result.focal_share = std::max(best.deviation(0), best.deviation(1)) / lens.fx;
  return result;
}

std::vector<cv::Point3d> things_on_board(const std::vector<cv::Point3d>& seen) {
  cv::Point3d low = seen.front();
  cv::Point3d high = low;
  for (const cv::Point3d& p : seen) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
  }
  const double height = std::max(high.x - low.x, high.y - low.y);
  std::vector<cv::Point3d> result;
  for (const double z : {0.0, height / 2, height}) {
    for (const double x : {low.x, high.x}) {
      for (const double y : {low.y, high.y}) result.emplace_back(x, y, z);
    }
  }
  return result;
}

std::optional<BoardPose> pose_by_board(const SeenBoard& view, const Lens& lens) {
  const BoardCamera camera(lens);
  std::optional<BoardPose> pose = best_pose(view, camera);
  if (pose && !pose->ambiguous) return pose;
  // Few corners, or nearly on a line; those of the markers are more, but not as good.
  SeenBoard all = view;
  all.corners.insert(all.corners.end(), view.marker_corners.begin(), view.marker_corners.end());
  all.points.insert(all.points.end(), view.marker_points.begin(), view.marker_points.end());
  if (std::optional<BoardPose> other = best_pose(all, camera)) return other;
  return pose;
}

}  // namespace nef::visual_hull
