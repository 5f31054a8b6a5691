// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/opacity.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace nef::visual_hull {

cv::Mat object_of(const cv::Mat& opacity) { return opacity >= kObjectOpacity; }

cv::Mat opacity_of(const cv::Mat& values, double level, double full, const cv::Mat& mask) {
  // Half of the contrast, so that neither side is cut off at 0 or 255, whatever the level.
  cv::Mat scaled;
  values.convertTo(scaled, CV_64F, 127.5 / full, 127.5 - level * 127.5 / full);
  cv::Mat inner;
  cv::Mat outer;
  const cv::Mat neighbours = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::erode(mask, inner, neighbours);
  cv::dilate(mask, outer, neighbours);
  cv::Mat result = mask.clone();
  for (int y = 0; y < mask.rows; ++y) {
    const auto* in = inner.ptr<std::uint8_t>(y);
    const auto* out = outer.ptr<std::uint8_t>(y);
    const auto* value = scaled.ptr<double>(y);
    auto* opacity = result.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x) {
      const bool object = opacity[x] != 0;
      if (in[x] == out[x] || object != (value[x] > 127.5)) continue;
      const auto rounded = cv::saturate_cast<std::uint8_t>(value[x]);
      opacity[x] = object ? std::max<std::uint8_t>(rounded, kObjectOpacity)
                          : std::min<std::uint8_t>(rounded, kObjectOpacity - 1);
    }
  }
  return result;
}

}  // namespace nef::visual_hull
