// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/half_contour.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/silhouette/opacity.h"
#include "apps/visual_hull/silhouette/silhouette.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

double area_of_rings(const Silhouette& s) {
  double sum = 0;
  for (const Ring& ring : s.rings) sum += twice_area(ring) / 2;
  return sum;
}

constexpr double kDiscRadius = 20.3;
constexpr double kDiscX = 31.7;
constexpr double kDiscY = 29.4;

// How much of each pixel a disc covers, by 32 x 32 points a pixel. Whole coordinates are centres of pixels.
cv::Mat covered_by_disc() {
  cv::Mat result(60, 64, CV_8U);
  constexpr int kSteps = 32;
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      int count = 0;
      for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
          const double u = x - 0.5 + (i + 0.5) / kSteps - kDiscX;
          const double v = y - 0.5 + (j + 0.5) / kSteps - kDiscY;
          count += std::hypot(u, v) < kDiscRadius ? 1 : 0;
        }
      }
      result.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(255.0 * count / (kSteps * kSteps));
    }
  }
  return result;
}

double largest_disc_error(const Silhouette& s) {
  double most = 0;
  for (const Point2& p : s.rings.at(0)) {
    most = std::max(most, std::fabs(std::hypot(p.approximate[0] - kDiscX, p.approximate[1] - kDiscY) - kDiscRadius));
  }
  return most;
}

TEST_CASE("The outline of a disc at half opacity is within a tenth of a pixel of the circle") {
  const cv::Mat disc = covered_by_disc();
  const Silhouette soft = trace_half_contours(disc, PixelOrigin::kCenter);
  REQUIRE(soft.rings.size() == 1);
  CHECK(check(soft).empty());
  CHECK(largest_disc_error(soft) < 0.1);
  CHECK(area_of_rings(soft) == Approx(std::numbers::pi * kDiscRadius * kDiscRadius).epsilon(2e-3));
  const Silhouette pixels = trace_contours(object_of(disc), PixelOrigin::kCenter);
  CHECK(largest_disc_error(pixels) > 0.4);
}

TEST_CASE("Whole coordinates are centres of pixels or their upper left corners") {
  const cv::Mat disc = covered_by_disc();
  const Silhouette centre = trace_half_contours(disc, PixelOrigin::kCenter);
  const Silhouette corner = trace_half_contours(disc, PixelOrigin::kCorner);
  REQUIRE(centre.rings.at(0).size() == corner.rings.at(0).size());
  for (std::size_t i = 0; i < centre.rings[0].size(); ++i) {
    CHECK(corner.rings[0][i].approximate[0] == centre.rings[0][i].approximate[0] + 0.5);
    CHECK(corner.rings[0][i].approximate[1] == centre.rings[0][i].approximate[1] + 0.5);
  }
}

TEST_CASE("Outlines at half opacity separate the centres of pixels, for any values") {
  cv::RNG random(11);
  for (int round = 0; round < static_cast<int>(nef::test::fewer(40)); ++round) {
    cv::Mat opacity(9, 12, CV_8U);
    random.fill(opacity, cv::RNG::UNIFORM, 0, 256);
    if (round % 2 == 1) {  // levels close to half, and plain masks
      for (std::uint8_t& value : cv::Mat_<std::uint8_t>(opacity))
        value = std::array<std::uint8_t, 4>{0, 127, 128, 255}[value % 4];
    }
    const Silhouette s = trace_half_contours(opacity, PixelOrigin::kCenter);
    CHECK(check(s).empty());
    int wrong = 0;
    for (int y = 0; y < opacity.rows; ++y) {
      for (int x = 0; x < opacity.cols; ++x) {
        const bool object = opacity.at<std::uint8_t>(y, x) >= kObjectOpacity;
        wrong += locate(s, Point2(x, y)) == (object ? Side::kInside : Side::kOutside) ? 0 : 1;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("Two pixels with a corner in common are joined where the mean of the four is half or more") {
  cv::Mat opacity = cv::Mat::zeros(4, 4, CV_8U);
  opacity.at<std::uint8_t>(1, 1) = opacity.at<std::uint8_t>(2, 2) = 200;
  CHECK(trace_half_contours(opacity, PixelOrigin::kCenter).rings.size() == 2);
  opacity.at<std::uint8_t>(1, 2) = opacity.at<std::uint8_t>(2, 1) = 100;
  CHECK(trace_half_contours(opacity, PixelOrigin::kCenter).rings.size() == 1);
}

TEST_CASE("An object that fills the image ends at the frame") {
  const Silhouette s = trace_half_contours(cv::Mat(3, 5, CV_8U, cv::Scalar(255)), PixelOrigin::kCorner);
  REQUIRE(s.rings.size() == 1);
  CHECK(locate(s, Point2(Rational(5, 2), 0)) == Side::kBoundary);
  CHECK(locate(s, Point2(5, Rational(3, 2))) == Side::kBoundary);
  CHECK(area_of_rings(s) == 15 - 4 * 0.125);  // corners are cut off
}

TEST_CASE("A soft silhouette: its threshold, its complement, its holes, what lies beyond the frame") {
  SilhouetteOptions options;
  options.soft = true;
  const cv::Mat disc = covered_by_disc();
  const cv::Mat opacity = make_opacity(disc, options.threshold);
  CHECK(cv::countNonZero(object_of(opacity) != make_mask(disc, options.threshold)) == 0);
  CHECK(area_of_rings(silhouette_of_mask(opacity, {}, "v", options).region) ==
        Approx(std::numbers::pi * kDiscRadius * kDiscRadius).epsilon(2e-3));

  options.threshold.invert = true;  // all but the disc
  const cv::Mat around = make_opacity(disc, options.threshold);
  const ViewSilhouette outside = silhouette_of_mask(around, {}, "v", options);
  CHECK(outside.holes == 1);
  CHECK(outside.cut_by_frame);
  CHECK(area_of_rings(outside.region) == Approx(60 * 64 - std::numbers::pi * kDiscRadius * kDiscRadius).epsilon(2e-3));
  options.border = Border::kUnknown;
  const ViewSilhouette open = silhouette_of_mask(around, {}, "v", options);
  CHECK(open.background);
  CHECK(area_of_rings(open.region) == Approx(std::numbers::pi * kDiscRadius * kDiscRadius).epsilon(2e-3));
  CHECK_THROWS_WITH(silhouette_of_mask(cv::Mat(5, 5, CV_8U, cv::Scalar(127)), {}, "v", options),
                    Catch::Contains("the silhouette is empty"));

  SilhouetteOptions low;  // a smaller disc is brighter than a higher level
  low.soft = true;
  low.threshold = parse_threshold("200");
  const double smaller = area_of_rings(silhouette_of_mask(make_opacity(disc, low.threshold), {}, "v", low).region);
  CHECK(smaller < 0.995 * std::numbers::pi * kDiscRadius * kDiscRadius);
}

TEST_CASE("Where a mask overrules the values, its pixels count") {
  cv::Mat values(5, 5, CV_8U, cv::Scalar(200));
  values.at<std::uint8_t>(2, 2) = 10;  // a hole that was filled
  const cv::Mat mask(5, 5, CV_8U, cv::Scalar(255));
  CHECK(cv::countNonZero(opacity_of(values, 100, 255, mask) != 255) == 0);
}

}  // namespace
}  // namespace nef::visual_hull
