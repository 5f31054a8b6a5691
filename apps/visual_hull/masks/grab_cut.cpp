// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/grab_cut.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "apps/visual_hull/masks/measures.h"
#include "apps/visual_hull/masks/separation.h"

namespace nef::visual_hull {
namespace {

constexpr double kMargin = 0.05;
constexpr int kRoundsOfRectangle = 5;
constexpr int kRoundsOfStrokes = 5;
constexpr int kRoundsOfSeeds = 2;

// OpenCV starts the mixtures with random numbers of the thread.
void be_repeatable() { cv::theRNG() = cv::RNG(1); }

cv::Mat object_in(const cv::Mat& seeds) { return (seeds == cv::GC_FGD) | (seeds == cv::GC_PR_FGD); }

cv::Mat cut_whole(const cv::Mat& picture, const cv::Rect& rectangle) {
  cv::Mat seeds(picture.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  cv::Mat background;
  cv::Mat object;
  be_repeatable();
  cv::grabCut(picture, seeds, rectangle, background, object, kRoundsOfRectangle, cv::GC_INIT_WITH_RECT);
  return object_above(object_in(seeds), 127);
}

cv::Mat cut_from_seeds(const cv::Mat& picture, cv::Mat seeds, int rounds) {
  const bool both = cv::countNonZero(seeds == cv::GC_FGD) > 0 && cv::countNonZero(seeds == cv::GC_BGD) > 0;
  if (both) {
    cv::Mat background;
    cv::Mat object;
    be_repeatable();
    cv::grabCut(picture, seeds, {}, background, object, rounds, cv::GC_INIT_WITH_MASK);
  }
  return object_in(seeds);
}

// The components of a mask that hold a pixel of another one.
cv::Mat components_with(const cv::Mat& mask, const cv::Mat& sure) {
  cv::Mat labels;
  const int count = cv::connectedComponents(mask, labels, 4);
  std::vector<bool> kept(static_cast<std::size_t>(count), false);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (sure.at<std::uint8_t>(y, x) != 0) kept[static_cast<std::size_t>(labels.at<int>(y, x))] = true;
    }
  }
  cv::Mat result = cv::Mat::zeros(mask.size(), CV_8U);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && kept[static_cast<std::size_t>(label)]) result.at<std::uint8_t>(y, x) = 255;
    }
  }
  return result;
}

// Sure but for the pixels within `inward` and `outward` pixels of the outline.
cv::Mat seeds_of(const cv::Mat& mask, double inward, double outward) {
  cv::Mat inside;
  cv::Mat outside;
  cv::distanceTransform(mask, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::distanceTransform(mask == 0, outside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat seeds(mask.size(), CV_8U, cv::Scalar(cv::GC_PR_BGD));
  seeds.setTo(cv::Scalar(cv::GC_PR_FGD), mask);
  seeds.setTo(cv::Scalar(cv::GC_FGD), inside > inward);
  seeds.setTo(cv::Scalar(cv::GC_BGD), outside > outward);
  return seeds;
}

}  // namespace

cv::Rect inside_margins(const cv::Size& size) {
  const int dx = static_cast<int>(kMargin * size.width) + 1;
  const int dy = static_cast<int>(kMargin * size.height) + 1;
  return {dx, dy, size.width - 2 * dx, size.height - 2 * dy};
}

cv::Mat cut_by_seeds(const cv::Mat& picture, const cv::Mat& seeds) {
  return cut_from_seeds(picture, seeds.clone(), kRoundsOfSeeds);
}

cv::Mat cut_by_strokes(const cv::Mat& picture, const cv::Mat& seeds) {
  const cv::Mat sure = seeds == cv::GC_FGD;
  const int side = std::max(picture.rows, picture.cols);
  if (side <= kLongestCopy) {
    return components_with(cut_from_seeds(picture, seeds.clone(), kRoundsOfStrokes), sure);
  }
  const double scale = static_cast<double>(kLongestCopy) / side;
  cv::Mat small;
  cv::Mat small_seeds;
  cv::resize(picture, small, cv::Size(), scale, scale, cv::INTER_AREA);
  cv::resize(seeds, small_seeds, small.size(), 0, 0, cv::INTER_NEAREST);
  cv::Mat mask;
  cv::resize(cut_from_seeds(small, small_seeds, kRoundsOfStrokes), mask, picture.size(), 0, 0, cv::INTER_NEAREST);
  cv::Mat fine = seeds_of(components_with(mask, sure), 3 / scale, 3 / scale);
  seeds.copyTo(fine, (seeds == cv::GC_FGD) | (seeds == cv::GC_BGD));
  return components_with(cut_by_seeds(picture, fine), sure);
}

cv::Mat cut_in_rectangle(const cv::Mat& picture, const cv::Rect& given) {
  const cv::Rect rectangle = given & cv::Rect(cv::Point(0, 0), picture.size());
  const bool outside = rectangle.area() > 0 && rectangle.area() < static_cast<int>(picture.total());
  if (!outside) return cv::Mat::zeros(picture.size(), CV_8U);  // nothing tells what the background is
  const int side = std::max(picture.rows, picture.cols);
  if (side <= kLongestCopy) return cut_whole(picture, rectangle);
  const double scale = static_cast<double>(kLongestCopy) / side;
  cv::Mat small;
  cv::resize(picture, small, cv::Size(), scale, scale, cv::INTER_AREA);
  const auto scaled = [scale](int value) { return static_cast<int>(value * scale); };
  const cv::Rect small_rectangle(scaled(rectangle.x), scaled(rectangle.y), std::max(1, scaled(rectangle.width)),
                                 std::max(1, scaled(rectangle.height)));
  cv::Mat mask;
  cv::resize(cut_whole(small, small_rectangle), mask, picture.size(), 0, 0, cv::INTER_NEAREST);
  return object_above(cut_by_seeds(picture, seeds_of(mask, 3 / scale, 3 / scale)), 127);
}

}  // namespace nef::visual_hull
