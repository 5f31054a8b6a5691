// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/cones/cone.h"

#include <catch2/catch.hpp>

#include "apps/visual_hull/cones/bounds.h"
#include "apps/visual_hull/silhouette/contour.h"
#include "nef/polyhedron.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using testing::axis_camera;
using testing::rectangle;
using testing::ring;

Rational clipped_volume(const Camera& camera, const Silhouette& silhouette, const WorldBox& box) {
  const nef::Polyhedron cone = make_cone(camera, silhouette, box);
  REQUIRE(nef::validate(cone.complex()) == "");
  const nef::Polyhedron clipped = nef::intersect(cone, nef::make_box(box.low, box.high));
  REQUIRE(clipped.is_closed());
  return nef::volume(clipped).value();
}

// A pyramid of base area a per depth squared has volume a (far^3 - near^3) / 3.
Rational frustum_volume(const Rational& area, const Rational& near, const Rational& far) {
  return area * (far * far * far - near * near * near) / 3;
}

TEST_CASE("The cone of a square has the volume of a frustum") {
  const WorldBox box{{-10, -10, 1}, {10, 10, 3}};
  const Silhouette square = make_silhouette({rectangle(-1, -1, 1, 1)}, "");
  for (const int direction : {1, -1}) {
    CAPTURE(direction);
    const Camera camera = axis_camera({0, 0, 0}, 2, direction);
    const WorldBox seen = direction > 0 ? box : WorldBox{{-10, -10, -3}, {10, 10, -1}};
    CHECK(camera.handedness() == direction);
    CHECK(clipped_volume(camera, square, seen) == frustum_volume(4, 1, 3));
    // The other half of the double cone is not seen.
    const WorldBox unseen = direction > 0 ? WorldBox{{-10, -10, -3}, {10, 10, -1}} : box;
    CHECK(make_cone(camera, square, unseen).is_empty());
  }
}

TEST_CASE("A camera in the box has a one-sided cone with its centre as apex") {
  const WorldBox box{{-10, -10, -5}, {10, 10, 3}};
  const Silhouette square = make_silhouette({rectangle(-1, -1, 1, 1)}, "");
  for (const int direction : {1, -1}) {
    const Camera camera = axis_camera({0, 0, 0}, 2, direction);
    const Rational far = direction > 0 ? 3 : 5;
    CHECK(clipped_volume(camera, square, box) == frustum_volume(4, 0, far));
    const nef::Polyhedron cone = make_cone(camera, square, box);
    CHECK(nef::contains(cone, {0, 0, 0}));
    CHECK_FALSE(nef::contains(cone, {0, 0, Rational(-direction, 1000)}));
    CHECK(nef::contains(cone, {0, 0, Rational(direction, 1000)}));
  }
}

TEST_CASE("Holes are tunnels and islands are cones of their own, also where they meet in the apex") {
  const Silhouette nested =
      make_silhouette({rectangle(-3, -3, 3, 3), rectangle(-2, -2, 2, 2), rectangle(-1, -1, 1, 1)}, "");
  const Rational area = 36 - 16 + 4;
  const Camera camera = axis_camera({0, 0, 0}, 2, 1);
  CHECK(clipped_volume(camera, nested, {{-20, -20, 1}, {20, 20, 3}}) == frustum_volume(area, 1, 3));
  CHECK(clipped_volume(camera, nested, {{-20, -20, -1}, {20, 20, 3}}) == frustum_volume(area, 0, 3));
  CHECK(nef::contains(make_cone(camera, nested, {{-20, -20, -1}, {20, 20, 3}}), {0, 0, 0}));
}

TEST_CASE("Rings that touch in a vertex share an edge of the cone") {
  const Silhouette touching = make_silhouette({rectangle(-2, -2, 2, 2), ring({{-2, 0}, {0, -1}, {0, 1}}),
                                               rectangle(2, 2, 4, 4), ring({{0, 1}, {-0.75, 0}, {-0.25, 0}})},
                                              "");
  REQUIRE(check(touching).empty());
  const Rational area = Rational(16) - 2 + 4 + Rational(1, 4);
  for (const int direction : {1, -1}) {
    const Camera camera = axis_camera({0, 0, 0}, 2, direction);
    const WorldBox front{{-20, -20, direction > 0 ? 1 : -3}, {20, 20, direction > 0 ? 3 : -1}};
    CHECK(clipped_volume(camera, touching, front) == frustum_volume(area, 1, 3));
    const WorldBox around{{-20, -20, -3}, {20, 20, 3}};
    CHECK(clipped_volume(camera, touching, around) == frustum_volume(area, 0, 3));
  }
}

TEST_CASE("Cones of random masks are valid and hold what their pixels see") {
  testing::property("volume is the number of pixels times a unit pixel's", [] {
    const int width = *rc::gen::inRange(1, 14);
    const int height = *rc::gen::inRange(1, 14);
    const cv::Mat mask =
        testing::random_mask(width, height, *rc::gen::inRange(0, 2), *rc::gen::arbitrary<std::uint64_t>());
    const Silhouette silhouette = trace_contours(mask, PixelOrigin::kCorner);
    const bool inside = *rc::gen::arbitrary<bool>();
    const Camera camera = axis_camera({0, 0, 0}, 2, *rc::gen::element(1, -1));
    const int sign = camera.handedness();
    const Rational near = inside ? 0 : 1;
    const Rational box_near = inside ? Rational(-1) : near;
    const Rational z0 = sign > 0 ? box_near : Rational(-2);
    const Rational z1 = sign > 0 ? Rational(2) : Rational(-box_near);
    const WorldBox box{{-100, -100, z0}, {100, 100, z1}};
    const nef::Polyhedron cone = make_cone(camera, silhouette, box);
    RC_ASSERT(nef::validate(cone.complex()) == "");
    const nef::Polyhedron clipped = nef::intersect(cone, nef::make_box(box.low, box.high));
    const int pixels = cv::countNonZero(mask);
    RC_ASSERT(nef::volume(clipped).value() == frustum_volume(pixels, near, 2));
  });
}

TEST_CASE("The box of a scene is found exactly") {
  // Cameras at distance 10 on two axes see |u|, |v| <= 1/8: |y|, |z| <= (10 + x) / 8, |x|, |z| <= (10 + y) / 8.
  const Silhouette square =
      make_silhouette({ring({{-0.125, -0.125}, {0.125, -0.125}, {0.125, 0.125}, {-0.125, 0.125}})}, "");
  std::vector<HalfSpace> half_spaces = convex_cone(axis_camera({-10, 0, 0}, 0, 1), square);
  CHECK(bounds_of(half_spaces).kind == Bounds::Kind::kUnbounded);
  const std::vector<HalfSpace> second = convex_cone(axis_camera({0, -10, 0}, 1, 1), square);
  half_spaces.insert(half_spaces.end(), second.begin(), second.end());
  const Bounds bounds = bounds_of(half_spaces);
  REQUIRE(bounds.kind == Bounds::Kind::kBox);
  // Largest x: 8x = 10 + y, 8y = 10 + x. Smallest: -8x = 10 + y with the largest y there, 8y = 10 + x.
  CHECK(bounds.box.high[0] == Rational(10, 7));
  CHECK(bounds.box.low[0] == Rational(-18, 13));
  CHECK(bounds.box.high[2] == Rational(10, 7));
  const WorldBox loose = loosen(bounds.box);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(loose.low[i] < bounds.box.low[i]);
    CHECK(loose.high[i] > bounds.box.high[i]);
  }
  const std::vector<HalfSpace> away = convex_cone(axis_camera({0, 0, 50}, 2, 1), square);
  half_spaces.insert(half_spaces.end(), away.begin(), away.end());
  CHECK(bounds_of(half_spaces).kind == Bounds::Kind::kEmpty);
}

}  // namespace
}  // namespace nef::visual_hull
