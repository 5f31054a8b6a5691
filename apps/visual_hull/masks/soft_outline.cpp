// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/soft_outline.h"

#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/masks/separation.h"
#include "apps/visual_hull/silhouette/opacity.h"

namespace nef::visual_hull {
namespace {

constexpr int kBand = 2;    // pixels on either side of an outline, which a lens blurs
constexpr int kAround = 9;  // side of the square whose pixels count as near by: shades of a curved object change fast

/// The mean of some pixels near each pixel; 0 where there are none.
struct NearMean {
  cv::Mat mean;
  cv::Mat known;

  NearMean(const cv::Mat& values, const cv::Mat& pixels) {
    cv::Mat counted;
    pixels.convertTo(counted, CV_32F, 1.0 / 255);
    const cv::Size around(kAround, kAround);
    cv::Mat count;
    cv::boxFilter(counted, count, CV_32F, around, {-1, -1}, false, cv::BORDER_CONSTANT);
    cv::boxFilter(values.mul(counted), mean, CV_32F, around, {-1, -1}, false, cv::BORDER_CONSTANT);
    known = count > 0.5;
    count.setTo(1, count <= 0.5);
    cv::divide(mean, count, mean);
  }
};

}  // namespace

cv::Mat soft_outline(const cv::Mat& measure, const cv::Mat& mask) {
  cv::Mat values;
  measure.convertTo(values, CV_32F);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kBand + 1, 2 * kBand + 1});
  cv::Mat inner;
  cv::Mat outer;
  cv::erode(mask, inner, disc);
  cv::dilate(mask, outer, disc);
  const NearMean object(values, inner);
  const NearMean background(values, outer == 0);
  cv::Mat above = values - (object.mean + background.mean) * 0.5;  // what is midway
  const cv::Mat decided = object.known & background.known & (object.mean > background.mean) & outer & (inner == 0);
  cv::Mat shifted = mask.clone();
  cv::Mat(above > 0).copyTo(shifted, decided);
  shifted = object_above(shifted, 127);
  above.setTo(255, (decided == 0) & shifted);  // what is not decided is 255 or 0
  above.setTo(-255, (decided == 0) & (shifted == 0));
  return opacity_of(above, 0, 255, shifted);
}

}  // namespace nef::visual_hull
