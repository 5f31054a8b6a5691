// SPDX-License-Identifier: Apache-2.0
//
// The votes of all silhouettes on a grid of points (votes.h) are projected into each view, once those points that all
// others allow (covered) and once those that at most one of them excludes (possible): one other mask may be wrong, too.
// A hull is larger than the object where no view sees into a hollow, so covered pixels are object only if their colours
// say so; pixels that are not possible are none, whatever their colours.
#include "apps/visual_hull/mask_repair/repair_masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/mask_repair/votes.h"
#include "apps/visual_hull/masks/grab_cut.h"
#include "apps/visual_hull/masks/measures.h"
#include "apps/visual_hull/silhouette/lens.h"
#include "apps/visual_hull/silhouette/silhouette.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

using refine::MovingCamera;
using refine::Outline;
using Outlines = std::vector<std::optional<Outline>>;

constexpr int kRepairRounds = 2;
constexpr std::size_t kFewestVotes = 4;
constexpr std::size_t kRepairSamples = 120;  // of an outline, to find the ball of the object
constexpr double kVoteMargin = 2;            // pixels that silhouettes and cameras may be off by
constexpr double kThick = 3;                 // pixels: the least half-width of what is decided again
constexpr double kToldShare = 0.001;         // share of a mask
constexpr double kDiagonal = 0.87;           // of a cube, half of it

Outlines outlines_of(const std::vector<PhotographedView>& views, PixelOrigin origin, const std::vector<cv::Mat>& masks,
                     const nef::Monitor& monitor) {
  Outlines outlines(views.size());
  nef::parallel_for(views.size(), monitor, [&](std::size_t i, const nef::Monitor& own) {
    if (cv::countNonZero(masks[i]) == 0) return;
    SilhouetteOptions options;
    options.origin = origin;
    const ViewSilhouette seen = silhouette_of_mask(masks[i], views[i].distortion, views[i].name, options, own);
    const ImageSize frame = seen.cut_by_frame ? ImageSize{masks[i].cols, masks[i].rows} : ImageSize{};
    outlines[i] = refine::make_outline(seen.region, frame, views[i].distortion, origin, kRepairSamples);
  });
  return outlines;
}

refine::Ball ball_of(const std::vector<MovingCamera>& cameras, const Outlines& outlines) {
  std::vector<MovingCamera> voting;
  std::vector<Outline> seen;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!outlines[i]) continue;
    voting.push_back(cameras[i]);
    seen.push_back(*outlines[i]);
  }
  return refine::object_ball(voting, seen);
}

cv::Mat disc(double radius) {
  const int r = static_cast<int>(std::ceil(radius));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * r + 1, 2 * r + 1});
}

/// Where a view sees the points of a grid.
struct SeenGrid {
  cv::Mat covered;    ///< those that no other view excludes
  cv::Mat possible;   ///< those that at most one other view excludes
  double radius = 0;  ///< pixels that a point stands for
};

SeenGrid seen_by(const PhotographedView& view, std::size_t number, PixelOrigin origin, const MovingCamera& camera,
                 const Votes& votes, const cv::Size& size) {
  SeenGrid seen{cv::Mat::zeros(size, CV_8U), cv::Mat::zeros(size, CV_8U), 0};
  const std::optional<LensModel> lens =
      view.distortion.coefficients.empty() ? std::nullopt : std::optional<LensModel>(LensModel(view.distortion));
  const double corner = origin == PixelOrigin::kCorner ? 0.5 : 0;
  for (const VotedPoint& point : votes.points) {
    const int against = point.against(number);
    const Eigen::Vector3d own = camera.inward(point.at);
    if (against > 1 || !(own.z() > 0)) continue;
    const Eigen::Vector2d straight = camera.seen(own);
    std::array<double, 2> p{straight.x(), straight.y()};
    if (lens) p = lens->distort(p);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) continue;
    const double x = std::round(p[0] - corner);
    const double y = std::round(p[1] - corner);
    if (!(x >= 0 && y >= 0 && x < size.width && y < size.height)) continue;
    seen.radius = std::max(seen.radius, kDiagonal * votes.step * camera.focal() / own.z());
    seen.possible.at<std::uint8_t>(static_cast<int>(y), static_cast<int>(x)) = 255;
    if (against == 0) seen.covered.at<std::uint8_t>(static_cast<int>(y), static_cast<int>(x)) = 255;
  }
  seen.radius += 1;
  cv::dilate(seen.covered, seen.covered, disc(seen.radius));
  cv::dilate(seen.possible, seen.possible, disc(seen.radius));
  return seen;
}

// The thick parts of what is covered and not in the mask, grown to the mask again.
cv::Mat missing_from(const cv::Mat& mask, const SeenGrid& seen) {
  cv::Mat covered;
  cv::erode(seen.covered, covered, disc(seen.radius + kVoteMargin));
  cv::Mat missing = covered & (mask == 0);
  cv::morphologyEx(missing, missing, cv::MORPH_OPEN, disc(kThick));
  if (cv::countNonZero(missing) > 0) cv::dilate(missing, missing, disc(seen.radius + kVoteMargin));
  return missing & (mask == 0) & seen.covered;
}

// The pixels of a region that are farther from its border than half of what any is.
cv::Mat inner_half(const cv::Mat& region) {
  cv::Mat depth;
  cv::distanceTransform(region, depth, cv::DIST_L2, cv::DIST_MASK_3);
  double deepest = 0;
  cv::minMaxLoc(depth, nullptr, &deepest);
  return depth > deepest / 2;
}

// A mask with what the others say about it. The photograph is read only if colours have to decide.
cv::Mat repaired(const std::filesystem::path& photograph, const cv::Mat& mask, const SeenGrid& seen) {
  cv::Mat result = mask & seen.possible;
  const cv::Mat missing = missing_from(result, seen);
  if (cv::countNonZero(missing) == 0) return result;
  // Colours are compared around the object only.
  const cv::Rect box = cv::boundingRect(seen.possible);
  const int margin = std::max(box.width, box.height) / 4 + 8;
  const cv::Rect around = cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
                          cv::Rect(cv::Point(0, 0), mask.size());
  cv::Mat seeds(mask.size(), CV_8U, cv::Scalar(cv::GC_PR_BGD));
  seeds.setTo(cv::Scalar(cv::GC_BGD), result == 0);
  seeds.setTo(cv::Scalar(cv::GC_FGD), result);
  seeds.setTo(cv::Scalar(cv::GC_PR_FGD), missing);
  if (cv::countNonZero(result) == 0) seeds.setTo(cv::Scalar(cv::GC_FGD), inner_half(missing));
  const cv::Mat object = cut_by_seeds(read_picture(photograph)(around), seeds(around));
  cv::Mat added = missing(around) & object;
  cv::morphologyEx(added, added, cv::MORPH_OPEN, disc(1));
  cv::bitwise_or(result(around), added, result(around));
  return result;
}

std::size_t vote_count(const Outlines& outlines) {
  return static_cast<std::size_t>(
      std::count_if(outlines.begin(), outlines.end(), [](const auto& outline) { return outline.has_value(); }));
}

MaskChange change_between(const cv::Mat& before, const cv::Mat& after) {
  MaskChange change;
  change.added = static_cast<std::size_t>(cv::countNonZero(after & (before == 0)));
  change.removed = static_cast<std::size_t>(cv::countNonZero(before & (after == 0)));
  const int had = cv::countNonZero(before);
  const double whole = had > 0 ? had : std::max<double>(1, static_cast<double>(change.added));
  change.share = static_cast<double>(change.added + change.removed) / whole;
  return change;
}

}  // namespace

std::vector<MaskChange> repair_masks(const std::vector<PhotographedView>& views, PixelOrigin origin,
                                     std::vector<cv::Mat>& masks, const nef::Monitor& monitor) {
  const std::vector<cv::Mat> given = masks;
  std::vector<MovingCamera> cameras;
  for (const PhotographedView& view : views) cameras.emplace_back(view.camera);
  for (int round = 0; round < kRepairRounds; ++round) {
    const Outlines outlines = outlines_of(views, origin, masks, monitor);
    if (vote_count(outlines) < kFewestVotes) break;
    const Votes votes = vote(cameras, outlines, ball_of(cameras, outlines), kVoteMargin, monitor);
    nef::parallel_for(views.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
      const SeenGrid seen = seen_by(views[i], i, origin, cameras[i], votes, masks[i].size());
      if (cv::countNonZero(seen.covered) == 0) return;  // the others agree on nothing
      masks[i] = repaired(views[i].photograph, masks[i], seen);
    });
  }
  std::vector<MaskChange> changes;
  for (std::size_t i = 0; i < views.size(); ++i) changes.push_back(change_between(given[i], masks[i]));
  return changes;
}

std::vector<std::string> change_lines(const std::vector<PhotographedView>& views,
                                      const std::vector<MaskChange>& changes) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const MaskChange& change = changes[i];
    if (change.share < kToldShare) continue;
    lines.push_back(fmt::format("mask of view {}: {} pixels added, {} removed ({:.1f} % of the object)", views[i].name,
                                change.added, change.removed, 100 * change.share));
  }
  return lines;
}

}  // namespace nef::visual_hull
