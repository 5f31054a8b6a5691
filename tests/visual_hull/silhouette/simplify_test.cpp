// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/simplify.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "apps/visual_hull/silhouette/contour.h"
#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using testing::random_mask;

double distance_to_ring(double x, double y, const Ring& ring) {
  double best = INFINITY;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& a = ring[i].approximate;
    const auto& b = ring[(i + 1) % ring.size()].approximate;
    const double dx = b[0] - a[0];
    const double dy = b[1] - a[1];
    const double t = std::min(1.0, std::max(0.0, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy)));
    best = std::min(best, std::hypot(x - a[0] - t * dx, y - a[1] - t * dy));
  }
  return best;
}

// The largest distance of points of `from`, sampled along its edges, to `to`.
double one_sided_distance(const Ring& from, const Ring& to) {
  double worst = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto& a = from[i].approximate;
    const auto& b = from[(i + 1) % from.size()].approximate;
    for (int k = 0; k < 8; ++k) {
      worst = std::max(worst, distance_to_ring(a[0] + (b[0] - a[0]) * k / 8, a[1] + (b[1] - a[1]) * k / 8, to));
    }
  }
  return worst;
}

TEST_CASE("Simplified silhouettes stay simple, nested and near, whatever the tolerance") {
  testing::property("promises of simplify", [] {
    const int width = *rc::gen::inRange(2, 40);
    const int height = *rc::gen::inRange(2, 40);
    const int smoothing = *rc::gen::inRange(0, 4);
    const double tolerance = *rc::gen::element(0.3, 0.75, 1.0, 1.7, 4.0, 20.0, 1000.0);
    const bool outer = *rc::gen::arbitrary<bool>();
    const cv::Mat mask = random_mask(width, height, smoothing, *rc::gen::arbitrary<std::uint64_t>());
    const Silhouette before = trace_contours(mask, PixelOrigin::kCenter);
    const Silhouette after = simplify(before, {tolerance, outer});
    RC_ASSERT(check(after) == "");
    RC_ASSERT(after.rings.size() == before.rings.size());
    RC_ASSERT(after.depth == before.depth);
    RC_ASSERT(after.parent == before.parent);
    for (std::size_t r = 0; r < before.rings.size(); ++r) {
      RC_ASSERT(after.rings[r].size() <= before.rings[r].size());
      RC_ASSERT(one_sided_distance(before.rings[r], after.rings[r]) <= tolerance);
      RC_ASSERT(one_sided_distance(after.rings[r], before.rings[r]) <= tolerance);
    }
    if (!outer) return;
    for (const Ring& ring : before.rings) {  // its boundary lies in the result, and so does each pixel
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2& a = ring[i];
        const Point2& b = ring[(i + 1) % ring.size()];
        for (int k = 0; k < 4; ++k) {
          const Point2 p(a.x() + (b.x() - a.x()) * Rational(k) / 4, a.y() + (b.y() - a.y()) * Rational(k) / 4);
          RC_ASSERT(locate(after, p) != Side::kOutside);
        }
      }
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (mask.at<std::uint8_t>(y, x) != 0) RC_ASSERT(locate(after, Point2(x, y)) != Side::kOutside);
      }
    }
  });
}

cv::Mat disc(int size, double radius) {
  cv::Mat mask(size, size, CV_8U, cv::Scalar(0));
  const double c = (size - 1) / 2.0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) mask.at<std::uint8_t>(y, x) = std::hypot(x - c, y - c) <= radius ? 255 : 0;
  }
  return mask;
}

TEST_CASE("A disc of radius 100 within one pixel needs few vertices") {
  const Silhouette contour = trace_contours(disc(220, 100), PixelOrigin::kCenter);
  // A chord of sagitta s spans an angle of 2 acos(1 - s/r). The corners of the pixels lie within 0.71 of
  // the circle, so a sagitta of 1 - 0.71 needs 42 chords, one of 1 + 0.71 needs 17.
  const std::size_t fewest = simplify(contour, {1, false}).vertex_count();
  CHECK(fewest <= 42);
  CHECK(fewest >= 17);
  // Within one pixel an outer polygon has no room: inner corners of the stairs are 0.71 from its chords.
  const std::size_t outer = simplify(contour, {1.5, true}).vertex_count();
  CHECK(outer <= 50);
}

TEST_CASE("Tolerance zero and straight contours") {
  const Silhouette square = trace_contours(cv::Mat(50, 50, CV_8U, cv::Scalar(255)), PixelOrigin::kCenter);
  CHECK(simplify(square, {0, false}).vertex_count() == 4);
  CHECK(simplify(square, {2, true}).vertex_count() == 4);
  CHECK_THROWS_AS(simplify(square, {-1, false}), nef::Error);
  CHECK_THROWS_AS(simplify(square, {NAN, false}), nef::Error);
}

TEST_CASE("A thin ring keeps its hole however coarse the tolerance") {
  cv::Mat mask(60, 60, CV_8U, cv::Scalar(0));
  cv::circle(mask, {30, 30}, 25, cv::Scalar(255), 2);
  const Silhouette contour = trace_contours(mask, PixelOrigin::kCenter);
  REQUIRE(contour.hole_count() == 1);
  for (const bool outer : {false, true}) {
    for (const double tolerance : {1.0, 3.0, 10.0, 100.0}) {
      const Silhouette after = simplify(contour, {tolerance, outer});
      CHECK(after.hole_count() == 1);
      CHECK(check(after).empty());
    }
  }
}

}  // namespace
}  // namespace nef::visual_hull
