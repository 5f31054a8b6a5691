// SPDX-License-Identifier: Apache-2.0
//
// The polygon is filled on a grid, the distance transform taken from both sides, and the result smoothed; samples are
// points along the polygon that are moved onto the zero of that field, so that both agree to a few hundredths of a
// pixel.
#include "apps/visual_hull/refine/outline.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/silhouette/lens.h"

namespace nef::visual_hull::refine {
namespace {

constexpr double kMargin = 10;        // nodes around the silhouette
constexpr double kBlur = 2;           // nodes: standard deviation
constexpr int kReach = 16;            // nodes: how far the blurs reach (OpenCV's end at four deviations)
constexpr double kMostNodes = 1200;   // along a side of the grid: larger silhouettes have coarser ones
constexpr std::size_t kPiece = 6;     // samples in a row that are held out together
constexpr double kNearFrame = 2.5;    // pixels: a side of the outline that may be the frame's
constexpr double kSmallestRing = 12;  // pixels around: less is noise

struct Bounds2 {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-HUGE_VAL);
};

Eigen::Vector2d at(const Point2& p) { return {p.approximate[0], p.approximate[1]}; }

Bounds2 bounds_of_rings(const Silhouette& silhouette) {
  Bounds2 box;
  for (const Ring& ring : silhouette.rings) {
    for (const Point2& p : ring) {
      box.low = box.low.cwiseMin(at(p));
      box.high = box.high.cwiseMax(at(p));
    }
  }
  return box;
}

// 255 at the nodes inside, by parity along each row.
cv::Mat filled(const Silhouette& silhouette, const Eigen::Vector2d& low, double step, int width, int height) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(height));
  for (const Ring& ring : silhouette.rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      Eigen::Vector2d a = (at(ring[k]) - low) / step;
      Eigen::Vector2d b = (at(ring[(k + 1) % ring.size()]) - low) / step;
      if (a.y() > b.y()) std::swap(a, b);
      const int first = std::max(0, static_cast<int>(std::ceil(a.y())));
      const int last = std::min(height - 1, static_cast<int>(std::ceil(b.y())) - 1);
      for (int y = first; y <= last; ++y) {
        const double x = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
        crossings[static_cast<std::size_t>(y)].push_back(x);
      }
    }
  }
  cv::Mat mask(height, width, CV_8U, cv::Scalar(0));
  for (int y = 0; y < height; ++y) {
    std::vector<double>& xs = crossings[static_cast<std::size_t>(y)];
    std::sort(xs.begin(), xs.end());
    for (std::size_t k = 0; k + 1 < xs.size(); k += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil(xs[k])));
      const int to = std::min(width - 1, static_cast<int>(std::ceil(xs[k + 1])) - 1);
      for (int x = from; x <= to; ++x) mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  return mask;
}

// Without the staircase of pixels. A Gaussian moves outlines inward where they bend (by half of its variance over the
// radius); twice the blurred field less the field blurred twice does not, to second order, so it may be wider: pixels
// of rendered sets move refined cameras by a third less than with a Gaussian of one pixel.
cv::Mat smoothed(const cv::Mat& field) {
  cv::Mat once;
  cv::Mat twice;
  cv::GaussianBlur(field, once, {}, kBlur, kBlur, cv::BORDER_REPLICATE);
  cv::GaussianBlur(once, twice, {}, kBlur, kBlur, cv::BORDER_REPLICATE);
  return 2 * once - twice;
}

}  // namespace

DistanceField::DistanceField(const Silhouette& silhouette, const ImageSize& frame, PixelOrigin origin)
    : frame_(frame.width > 0) {
  Bounds2 box = bounds_of_rings(silhouette);
  const double extent = (box.high - box.low).maxCoeff();
  // Pixels, but for polygons in other units and for images that are larger than the answer needs.
  step_ = extent > 64 ? std::max(1.0, extent / kMostNodes) : extent / 400;
  if (frame_) {
    const double corner = origin == PixelOrigin::kCorner ? 0.5 : 0;
    box.low.setConstant(corner);
    box.high = Eigen::Vector2d(frame.width - 1, frame.height - 1).array() + corner;
    low_ = box.low;
  } else {
    low_ = box.low - Eigen::Vector2d::Constant(kMargin * step_);
    low_ = low_.array().floor();  // nodes are centres of pixels
    if (step_ < 1) low_ = box.low - Eigen::Vector2d::Constant(kMargin * step_);
    if (origin == PixelOrigin::kCorner) low_.array() += 0.5;
    box.high += Eigen::Vector2d::Constant(kMargin * step_);
  }
  width_ = std::max(2, static_cast<int>(std::ceil((box.high.x() - low_.x()) / step_)) + 1);
  height_ = std::max(2, static_cast<int>(std::ceil((box.high.y() - low_.y()) / step_)) + 1);
  // Blurs see what they would see on a grid without end. Beyond a frame the distance goes on as it is there.
  const int around = frame_ ? 0 : kReach;
  const cv::Mat mask = filled(silhouette, low_ - Eigen::Vector2d::Constant(around * step_), step_, width_ + 2 * around,
                              height_ + 2 * around);
  cv::Mat inside;
  cv::Mat outside;
  cv::distanceTransform(mask, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  cv::distanceTransform(255 - mask, outside, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  cv::Mat distance = inside - outside;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      // From the centre of a pixel to the border between pixels.
      distance.at<float>(y, x) -= mask.at<std::uint8_t>(y, x) != 0 ? 0.5F : -0.5F;
    }
  }
  distance = step_ * smoothed(distance)(cv::Rect(around, around, width_, height_));
  values_.assign(distance.begin<float>(), distance.end<float>());
}

DistanceField::Cell DistanceField::cell(const Eigen::Vector2d& p) const {
  const double x = (p.x() - low_.x()) / step_;
  const double y = (p.y() - low_.y()) / step_;
  const double within_x = std::clamp(x, 0.0, width_ - 1.0);
  const double within_y = std::clamp(y, 0.0, height_ - 1.0);
  const int i = std::min(static_cast<int>(within_x), width_ - 2);
  const int j = std::min(static_cast<int>(within_y), height_ - 2);
  return {values_.data() + static_cast<std::ptrdiff_t>(j) * width_ + i, within_x - i, within_y - j,
          Eigen::Vector2d(x - within_x, y - within_y) * step_};
}

double DistanceField::value(const Eigen::Vector2d& p) const {
  const Cell c = cell(p);
  const double above = c.at[0] + c.x * (c.at[1] - c.at[0]);
  const float* under = c.at + width_;
  const double below = under[0] + c.x * (under[1] - under[0]);
  const double result = above + c.y * (below - above);
  if (frame_ || (c.beyond.x() == 0 && c.beyond.y() == 0)) return result;
  return result - c.beyond.norm();
}

double DistanceField::value(const Eigen::Vector2d& p, Eigen::Vector2d& gradient) const {
  const Cell c = cell(p);
  const float* under = c.at + width_;
  const double dx_above = c.at[1] - c.at[0];
  const double dx_below = under[1] - under[0];
  const double above = c.at[0] + c.x * dx_above;
  const double below = under[0] + c.x * dx_below;
  gradient = Eigen::Vector2d(dx_above + c.y * (dx_below - dx_above), below - above) / step_;
  const double result = above + c.y * (below - above);
  const double beyond = c.beyond.norm();
  if (beyond == 0) return result;
  if (frame_) {  // constant across the frame
    if (c.beyond.x() != 0) gradient.x() = 0;
    if (c.beyond.y() != 0) gradient.y() = 0;
    return result;
  }
  gradient = -c.beyond / beyond;
  return result - beyond;
}

namespace {

// Whether a point of the outline lies on the frame of the image, where the object need not end.
bool on_frame(const Eigen::Vector2d& p, const ImageSize& frame, const LensModel* lens, PixelOrigin origin) {
  if (frame.width == 0) return false;
  std::array<double, 2> seen{p.x(), p.y()};
  if (lens != nullptr) seen = lens->distort(seen);
  const double corner = origin == PixelOrigin::kCorner ? 0 : 0.5;  // the frame is from -.5, or from 0
  const double x = seen[0] + corner;
  const double y = seen[1] + corner;
  return !(x > kNearFrame && y > kNearFrame && x < frame.width - kNearFrame && y < frame.height - kNearFrame);
}

double length_of(const Ring& ring) {
  double length = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) length += (at(ring[(k + 1) % ring.size()]) - at(ring[k])).norm();
  return length;
}

// Onto the zero of the field, by Newton's method.
Eigen::Vector2d onto_outline(const DistanceField& field, Eigen::Vector2d p) {
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector2d g;
    const double d = field.value(p, g);
    const double size = g.squaredNorm();
    if (!(size > 0.04)) break;
    p -= d / size * g;
  }
  return p;
}

}  // namespace

Outline make_outline(const Silhouette& silhouette, const ImageSize& frame, const Distortion& lens, PixelOrigin origin,
                     std::size_t count) {
  Outline outline;
  outline.distance = DistanceField(silhouette, frame, origin);
  const Bounds2 box = bounds_of_rings(silhouette);
  outline.middle = (box.low + box.high) / 2;
  outline.extent = (box.high - box.low).maxCoeff();
  const std::optional<LensModel> model =
      lens.coefficients.empty() ? std::nullopt : std::optional<LensModel>(LensModel(lens));
  const double smallest = outline.extent > 64 ? kSmallestRing : 0;
  double total = 0;
  for (const Ring& ring : silhouette.rings) {
    const double length = length_of(ring);
    if (length >= smallest) total += length;
  }
  const double gap = total / static_cast<double>(count);
  std::size_t number = 0;
  for (const Ring& ring : silhouette.rings) {
    if (length_of(ring) < smallest) continue;
    double next = gap / 2;  // from the start of the side
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2d a = at(ring[k]);
      const Eigen::Vector2d b = at(ring[(k + 1) % ring.size()]);
      const double length = (b - a).norm();
      for (; next < length; next += gap, ++number) {
        const Eigen::Vector2d p = a + next / length * (b - a);
        if (on_frame(p, frame, model ? &*model : nullptr, origin)) continue;
        outline.samples.push_back({onto_outline(outline.distance, p), number / kPiece % 2 == 1});
      }
      next -= length;
    }
  }
  return outline;
}

}  // namespace nef::visual_hull::refine
