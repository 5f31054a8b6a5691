// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/soft_outline.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/masks/separation.h"
#include "apps/visual_hull/silhouette/half_contour.h"
#include "apps/visual_hull/silhouette/opacity.h"

namespace nef::visual_hull {
namespace {

constexpr double kHalfWidth = 41.3;
constexpr double kHalfHeight = 27.6;

// How dark an ellipse about (70, 50) is, from 110 on the left to 230 on the right, before 40, as a camera sees it.
cv::Mat shaded_ellipse() {
  constexpr int kSteps = 8;
  cv::Mat large(100 * kSteps, 140 * kSteps, CV_32F);
  for (int y = 0; y < large.rows; ++y) {
    for (int x = 0; x < large.cols; ++x) {
      const double u = (x + 0.5) / kSteps - 0.5;
      const double v = (y + 0.5) / kSteps - 0.5;
      const bool inside = std::hypot((u - 70) / kHalfWidth, (v - 50) / kHalfHeight) < 1;
      large.at<float>(y, x) = static_cast<float>(inside ? 110 + 120 * u / 140 : 40);
    }
  }
  cv::Mat small;
  cv::resize(large, small, {140, 100}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {}, 0.5);
  cv::Mat result;
  small.convertTo(result, CV_8U);
  return result;
}

// The mean distance of the vertices outside of the ellipse, along rays from its middle.
double mean_offset(const Silhouette& s) {
  double sum = 0;
  for (const Point2& p : s.rings.at(0)) {
    const double u = p.approximate[0] - 70;
    const double v = p.approximate[1] - 50;
    const double r = std::hypot(u, v);
    sum += r - r / std::hypot(u / kHalfWidth, v / kHalfHeight);
  }
  return sum / static_cast<double>(s.rings[0].size());
}

TEST_CASE("A soft outline does not depend on the level, nor on shades along it") {
  const cv::Mat ellipse = shaded_ellipse();
  for (const double level : {55.0, 75.0, 100.0}) {
    const cv::Mat mask = object_above(ellipse, level);
    const Silhouette soft = trace_half_contours(soft_outline(ellipse, mask), PixelOrigin::kCenter);
    REQUIRE(soft.rings.size() == 1);
    CHECK(std::fabs(mean_offset(soft)) < 0.03);
  }
  const cv::Mat low = object_above(ellipse, 55);
  const cv::Mat by_level = opacity_of(ellipse, 55, 255, low);
  CHECK(mean_offset(trace_half_contours(by_level, PixelOrigin::kCenter)) > 0.1);
}

TEST_CASE("Where no object or no background is near by, an outline stays along pixels") {
  cv::Mat measure(20, 20, CV_8U, cv::Scalar(200));
  const cv::Mat all(20, 20, CV_8U, cv::Scalar(255));
  CHECK(cv::countNonZero(soft_outline(measure, all) != all) == 0);
  measure.setTo(0);
  cv::Mat thin = cv::Mat::zeros(20, 20, CV_8U);
  thin.row(10).setTo(255);
  CHECK(cv::countNonZero(soft_outline(measure, thin) != thin) == 0);
}

}  // namespace
}  // namespace nef::visual_hull
