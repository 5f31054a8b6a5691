// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/grab_cut.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/masks/measures.h"
#include "apps/visual_hull/masks/separation.h"

namespace nef::visual_hull {
namespace {

constexpr int kRoundsOfRectangle = 5;
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

cv::Mat cut_by_seeds(const cv::Mat& picture, const cv::Mat& given) {
  cv::Mat seeds = given.clone();
  const bool both = cv::countNonZero(seeds == cv::GC_FGD) > 0 && cv::countNonZero(seeds == cv::GC_BGD) > 0;
  if (both) {
    cv::Mat background;
    cv::Mat object;
    be_repeatable();
    cv::grabCut(picture, seeds, {}, background, object, kRoundsOfSeeds, cv::GC_INIT_WITH_MASK);
  }
  return object_in(seeds);
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
