// SPDX-License-Identifier: Apache-2.0
//
// Cameras with parallel lines of sight: hulls of masks along the axes are sets of voxels that can be counted.
#include <catch2/catch.hpp>

#include "apps/visual_hull/color/projection.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::axis_camera;
using testing::box_corners;
using testing::convex_silhouette;
using testing::cube;
using testing::rectangle;
using testing::scene_of;

/// (u, v) are the coordinates axis + 1 and axis + 2, times a scale.
Camera along(std::size_t axis, const Rational& scale = 1, const std::string& name = "parallel") {
  Matrix34 m;
  m[0][(axis + 1) % 3] = 1;
  m[1][(axis + 2) % 3] = 1;
  m[2][3] = 1 / scale;
  return {name, m};
}

TEST_CASE("The hull of three masks along the axes is the voxels that all three show") {
  testing::property("volumes are counts, either way", [] {
    const int n = *rc::gen::inRange(2, 9);
    std::vector<cv::Mat> masks;
    Scene scene;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      masks.push_back(testing::random_mask(n, n, *rc::gen::inRange(0, 2), *rc::gen::arbitrary<std::uint64_t>()));
      if (cv::countNonZero(masks.back()) == 0) return;
      View view;
      view.name = std::to_string(axis);
      view.camera = along(axis);
      view.polygons = trace_contours(masks.back(), PixelOrigin::kCorner).rings;
      scene.views.push_back(std::move(view));
    }
    int count = 0;
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        for (int z = 0; z < n; ++z) {
          const bool in = masks[0].at<std::uint8_t>(z, y) != 0 && masks[1].at<std::uint8_t>(x, z) != 0 &&
                          masks[2].at<std::uint8_t>(y, x) != 0;
          count += in ? 1 : 0;
        }
      }
    }
    scene.box = WorldBox{{-1, -1, -1}, {n + 1, n + 1, n + 1}};
    for (const Way way : {Way::kCones, Way::kBest}) {
      Options options;
      options.way = way;
      options.verify = true;
      const Result result = compute(scene, {}, options);
      RC_ASSERT(nef::validate(result.hull.complex()) == "");
      RC_ASSERT(result.vanished.has_value() == (count == 0));
      if (count == 0) continue;
      RC_ASSERT(nef::volume(result.hull).value() == count);
      for (const ViewResult& view : result.views) RC_ASSERT(view.verification->inside);
    }
  });
}

TEST_CASE("The direct way takes parallel lines of sight, and pinholes beside them") {
  // A box seen along the axes is the box; a pinhole in front of it takes nothing away.
  const Rational3 low{-3, -2, -1};
  const Rational3 high{3, 2, 1};
  Scene scene = scene_of({{along(0), {rectangle(-2, -1, 2, 1)}},
                          {along(1, Rational(5, 2)), {rectangle(-2.5, -7.5, 2.5, 7.5)}},
                          {along(2), {rectangle(-3, -2, 3, 2)}}},
                         cube(10));
  scene.box.reset();
  Options options;
  options.way = Way::kDirect;
  const Result three = compute(scene, {}, options);
  CHECK(three.direct);
  CHECK(nef::equal(three.hull, nef::make_box(low, high)));
  View pinhole;
  pinhole.camera = axis_camera({50, 0, 0}, 0, -1, "pinhole");
  pinhole.name = "pinhole";
  pinhole.polygons = convex_silhouette(pinhole.camera, box_corners(low, high)).rings;
  scene.views.push_back(pinhole);
  CHECK(nef::equal(compute(scene, {}, options).hull, three.hull));
  options.way = Way::kCones;
  CHECK(nef::equal(compute(scene, {}, options).hull, three.hull));
  CHECK_THAT(understood(scene), Contains("3 with parallel lines of sight") && Contains("focal length 1"));
}

TEST_CASE("Points are where a parallel camera sees them") {
  Matrix34 m{{{2, 1, 0, 3}, {0, 3, -1, 4}, {0, 0, 0, 2}}};
  const Camera camera("affine", m);
  CHECK(camera.is_parallel());
  const Point2 image(Rational(1, 3), 7);
  for (const int depth : {-4, 0, 9}) {
    const Rational3 point = camera.sight_point(image, depth);
    CHECK(camera.depth(point) == depth);
    const Projection seen = camera.project(point);
    CHECK(seen.x / seen.depth == image.x());
    CHECK(seen.y / seen.depth == image.y());
  }
  // Of a pinhole, too.
  const Camera pinhole = axis_camera({1, 2, 3}, 1, -1);
  const Rational3 point = pinhole.sight_point(image, 5);
  CHECK(pinhole.depth(point) == 5);
  CHECK(pinhole.project(point).x / 5 == image.x());
}

TEST_CASE("What is no camera, and what needs pinholes, is refused by name") {
  CHECK_THROWS_WITH(Camera("back", Matrix34{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, -1}}}),
                    Contains("view back: nothing is in front"));
  CHECK_THROWS_WITH(Camera("flat", Matrix34{{{1, 2, 0, 0}, {2, 4, 0, 0}, {0, 0, 0, 1}}}),
                    Contains("view flat: the matrix is singular"));
  const Scene scene =
      scene_of({{along(0), {rectangle(-2, -1, 2, 1)}}, {along(1), {rectangle(-1, -3, 1, 3)}}}, cube(10));
  Options options;
  options.suspects = true;
  CHECK_THROWS_WITH(compute(scene, {}, options),
                    Contains("view parallel: its lines of sight are parallel; --suspects"));
  options.suspects = false;
  options.refine = true;
  CHECK_THROWS_AS(compute(scene, {}, options), nef::InputError);
  CHECK_THROWS_WITH(ImageProjection(along(0), PixelOrigin::kCenter, "--color"), Contains("--color is for pinhole"));
}

}  // namespace
}  // namespace nef::visual_hull
