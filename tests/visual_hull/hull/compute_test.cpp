// SPDX-License-Identifier: Apache-2.0
//
// Hulls of known solids. All comparisons are exact, as are those of apps/visual_hull/verify/.
#include <catch2/catch.hpp>
#include <set>

#include "nef/base/error.h"
#include "nef/polyhedron.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using testing::axis_camera;
using testing::box_corners;
using testing::convex_silhouette;
using testing::cube;
using testing::rectangle;
using testing::scene_of;
using testing::subset;

using Views = std::vector<std::pair<Camera, std::vector<Ring>>>;

nef::Polyhedron hull_of(const Views& views, const WorldBox& box = cube(100)) {
  return compute(scene_of(views, box), {}, {}).hull;
}

std::pair<Camera, std::vector<Ring>> view_of(const Camera& camera, const std::vector<Rational3>& vertices) {
  return {camera, convex_silhouette(camera, vertices).rings};
}

// A camera that looks from `centre` towards the origin, whatever its roll: depth is the distance along the
// axis of the largest coordinate.
Camera towards_origin(const Rational3& centre, const std::string& name = "camera") {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(centre[i]) > abs(centre[axis])) axis = i;
  }
  return axis_camera(centre, axis, sgn(centre[axis]) < 0 ? 1 : -1, name);
}

TEST_CASE("Six cameras on the axes give a cube its caps") {
  // From (500, 0, 0) the near face of the cube [-10, 10]^3 is all that is seen. Its cone goes on beyond the
  // face; between the cones of two opposite sides a pyramid remains on each face: from y = 500 the plane
  // through the edge x = z = 10 ... meets its mirror image on the axis, at 500/49.
  Views views;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      Rational3 centre;
      centre[axis] = 500 * sign;
      views.push_back(view_of(towards_origin(centre), box_corners({-10, -10, -10}, {10, 10, 10})));
    }
  }
  const nef::Polyhedron hull = hull_of(views);
  CHECK(nef::validate(hull.complex()) == "");
  CHECK(nef::counts(hull).vertices == 14);
  CHECK(nef::counts(hull).facets == 24);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      Rational3 apex;
      apex[axis] = Rational(500 * sign, 49);
      CHECK(nef::locate(hull, apex).kind == nef::Location::Kind::kVertex);
    }
  }
  // The cube, and six pyramids of base 400 and height 500/49 - 10 = 10/49.
  CHECK(nef::volume(hull).value() == Rational(8000) + 6 * Rational(400) * Rational(10, 49) / 3);
  CHECK(subset(nef::make_box({-10, -10, -10}, {10, 10, 10}), hull));
}

TEST_CASE("Cameras in the planes of all faces give the cube itself") {
  const std::vector<Rational3> corners = box_corners({-10, -10, -10}, {10, 10, 10});
  Views views;
  // A camera on the line of an edge sees the two faces there edge-on.
  views.push_back(view_of(towards_origin({70, 10, 10}), corners));
  views.push_back(view_of(towards_origin({-70, -10, -10}), corners));
  views.push_back(view_of(towards_origin({10, 90, -10}), corners));
  views.push_back(view_of(towards_origin({-10, -90, 10}), corners));
  const nef::Polyhedron box = nef::make_box({-10, -10, -10}, {10, 10, 10});
  CHECK(nef::equal(hull_of(views), box));
  // Any further view of the cube changes nothing.
  views.push_back(view_of(towards_origin({31, 47, 110}), corners));
  CHECK(nef::equal(hull_of(views), box));
}

// Twelve cameras around, none in special position.
std::vector<Rational3> around() {
  return {{200, 17, 31}, {-190, 40, 3},  {11, 180, 23}, {5, -170, 44},
          {33, 21, 190}, {-40, 5, -210}, {150, 140, 9}, {-160, 130, 50}};
}

TEST_CASE("Hulls of convex solids hold them, shrink with every view, and do not depend on the order") {
  testing::property("random convex solids", [] {
    const auto coordinate = rc::gen::inRange(-20, 21);
    std::vector<Rational3> points;
    for (int i = 0; i < 7; ++i) points.push_back({*coordinate, *coordinate, *coordinate});
    const nef::Polyhedron solid = nef::convex_hull(points);
    RC_PRE(!nef::interior(solid).is_empty());
    Views views;
    nef::Polyhedron previous = nef::make_box({-100, -100, -100}, {100, 100, 100});
    for (const Rational3& centre : around()) {
      if (views.size() >= 5) break;
      views.push_back(view_of(towards_origin(centre), points));
      const nef::Polyhedron hull = hull_of(views);
      RC_ASSERT(nef::validate(hull.complex()) == "");
      RC_ASSERT(subset(solid, hull));
      RC_ASSERT(subset(hull, previous));
      previous = hull;
    }
    const std::vector<std::size_t> order{3, 0, 4, 2, 1};
    Views shuffled;
    for (const std::size_t i : order) shuffled.push_back(views[i]);
    RC_ASSERT(nef::equal(hull_of(shuffled), previous));
  });
}

TEST_CASE("Two cameras a hair apart, and cones that share edges and planes") {
  const std::vector<Rational3> corners = box_corners({-10, -10, -10}, {10, 10, 10});
  const nef::Polyhedron solid = nef::make_box({-10, -10, -10}, {10, 10, 10});
  const Rational hair(1, Integer("1000000000000000000000000000000"));
  Views views{view_of(towards_origin({500, 3, 7}), corners), view_of(towards_origin({0, 500, 2}), corners),
              view_of(towards_origin({0, 0, 500}), corners)};
  const nef::Polyhedron before = hull_of(views);
  views.push_back(view_of(towards_origin({500 + hair, 3, 7 - hair}), corners));
  const nef::Polyhedron after = hull_of(views);
  CHECK(nef::validate(after.complex()) == "");
  CHECK(subset(after, before));
  CHECK_FALSE(nef::equal(after, before));
  CHECK(subset(solid, after));
  // The same camera twice changes nothing.
  views.push_back(views[0]);
  CHECK(nef::equal(hull_of(views), after));
  // A camera farther out on the line through an edge of the solid shares that edge's planes.
  Views sharing{view_of(towards_origin({60, 10, 10}), corners), view_of(towards_origin({90, 10, 10}), corners),
                view_of(towards_origin({0, 0, 500}), corners), view_of(towards_origin({0, 500, 0}), corners)};
  const nef::Polyhedron shared = hull_of(sharing);
  CHECK(nef::validate(shared.complex()) == "");
  CHECK(subset(solid, shared));
}

// The frame [-10, 10]^3 without the square tunnel |x|, |y| < 4 along z.
nef::Polyhedron frame() {
  return nef::closure(
      nef::subtract(nef::make_box({-10, -10, -10}, {10, 10, 10}), nef::make_box({-4, -4, -11}, {4, 4, 11})));
}

TEST_CASE("A frame seen through its hole has a hull of genus one") {
  const std::vector<Rational3> corners = box_corners({-10, -10, -10}, {10, 10, 10});
  // From (0, 0, 100) the far end of the tunnel limits the view: 4 / 110 of depth.
  const Camera front = towards_origin({0, 0, 100}, "front");
  Views views{{front, convex_silhouette(front, corners).rings}};
  Ring hole;
  for (const auto& [x, y] : std::vector<std::array<int, 2>>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    hole.emplace_back(Rational(2 * x, 55), Rational(2 * y, 55));
  }
  views[0].second.push_back(hole);
  views.push_back(view_of(towards_origin({100, 0, 0}), corners));
  views.push_back(view_of(towards_origin({0, 100, 0}), corners));
  const nef::Polyhedron hull = hull_of(views);
  CHECK(nef::validate(hull.complex()) == "");
  CHECK(subset(frame(), hull));
  CHECK_FALSE(nef::contains(hull, {0, 0, 0}));
  const std::vector<long> euler = nef::euler_numbers(hull);
  CHECK(std::set<long>(euler.begin(), euler.end()) == std::set<long>{0});
  // The tunnel of the hull is the cone of the hole: narrower than the frame's at the near end.
  CHECK(nef::contains(hull, {3, 0, 10}) == (Rational(1, 30) >= Rational(2, 55)));
  CHECK(nef::contains(hull, {Rational(36, 11) + Rational(1, 100), 0, 10}));
}

TEST_CASE("A polygonal torus keeps its hole from an axis camera and loses it from the side") {
  // A torus of square cross-section around z, octagonal: seen from the axis as two octagons.
  const auto octagon = [](const Rational& r) {
    const Rational d = r * Rational(70, 99);
    return std::vector<std::array<Rational, 2>>{{r, 0}, {d, d}, {0, r}, {-d, d}, {-r, 0}, {-d, -d}, {0, -r}, {d, -d}};
  };
  std::vector<Rational3> outer;
  std::vector<Rational3> inner_bottom;
  for (const auto& p : octagon(10)) {
    outer.push_back({p[0], p[1], -2});
    outer.push_back({p[0], p[1], 2});
  }
  for (const auto& p : octagon(5)) inner_bottom.push_back({p[0], p[1], -2});
  const Camera top = towards_origin({0, 0, 60}, "top");
  Views views{{top, convex_silhouette(top, outer).rings}};
  views[0].second.push_back(convex_silhouette(top, inner_bottom).rings[0]);
  views.push_back(view_of(towards_origin({80, 3, 1}), outer));
  const nef::Polyhedron two = hull_of(views);
  std::vector<Rational3> inner_solid;
  for (const auto& p : octagon(5)) {
    inner_solid.push_back({p[0], p[1], -3});
    inner_solid.push_back({p[0], p[1], 3});
  }
  const nef::Polyhedron torus = nef::closure(nef::subtract(nef::convex_hull(outer), nef::convex_hull(inner_solid)));
  CHECK(subset(torus, two));
  const std::vector<long> euler = nef::euler_numbers(two);
  CHECK(std::set<long>(euler.begin(), euler.end()) == std::set<long>{0});
  // Without the view from the top there is no hole.
  const Views side{views[1], view_of(towards_origin({2, 85, 3}), outer)};
  for (const long number : nef::euler_numbers(hull_of(side))) CHECK(number == 2);
}

TEST_CASE("A camera inside the scene sees one side of it") {
  // Three cameras at the origin's neighbourhood look along +z; what is behind is carved.
  const Camera camera = axis_camera({0, 0, 0}, 2, 1, "inside");
  const nef::Polyhedron hull = hull_of({{camera, {rectangle(-1, -1, 1, 1)}}}, cube(10));
  CHECK(nef::volume(hull).value() == Rational(4000, 3));  // height 10, base 20 x 20
  CHECK(nef::locate(hull, {0, 0, 0}).kind == nef::Location::Kind::kVertex);
  // Two that look at each other from within the box: depth meets depth.
  const nef::Polyhedron both = hull_of({{axis_camera({0, 0, -5}, 2, 1), {rectangle(-1, -1, 1, 1)}},
                                        {axis_camera({0, 0, 5}, 2, -1), {rectangle(-1, -1, 1, 1)}}},
                                       cube(10));
  CHECK(nef::volume(both).value() == Rational(1000, 3));  // two pyramids base to base
}

TEST_CASE("The view at which the hull vanishes is named") {
  const Ring square = rectangle(-0.25, -0.25, 0.25, 0.25);
  const Views views{{axis_camera({-10, 0, 0}, 0, 1, "first"), {square}},
                    {axis_camera({0, -10, 0}, 1, 1, "second"), {square}},
                    {axis_camera({0, 0, 50}, 2, 1, "third looks away"), {square}},
                    {axis_camera({0, 0, -10}, 2, 1, "fourth"), {square}}};
  const Result empty = compute(scene_of(views, cube(20)), {}, {});
  REQUIRE(empty.vanished.has_value());
  CHECK(empty.hull.is_empty());
  CHECK(empty.vanished->view == "third looks away");
  CHECK(empty.vanished->reason.find("behind its camera") != std::string::npos);
  Scene no_box = scene_of(views, cube(20));
  no_box.box.reset();
  const Result unboxed = compute(no_box, {}, {});
  REQUIRE(unboxed.vanished.has_value());
  CHECK(unboxed.vanished->view == "third looks away");
  // Cones that touch in an edge only: flat. The first sees y <= 0 at most, the second y >= 0.
  const Views touching{{axis_camera({-10, 0, 0}, 0, 1, "low"), {rectangle(-1, -1, 0, 1)}},
                       {axis_camera({-20, 0, 0}, 0, 1, "high"), {rectangle(0, -1, 1, 1)}}};
  const Result flat = compute(scene_of(touching, cube(5)), {}, {});
  REQUIRE(flat.vanished.has_value());
  CHECK_FALSE(flat.hull.is_empty());
  CHECK(flat.vanished->view == "high");
}

TEST_CASE("Pieces of a hull are told, and the largest is kept alone if that is asked for") {
  const std::vector<Rational3> large = box_corners({-10, -10, -10}, {10, 10, 10});
  const std::vector<Rational3> small = box_corners({-1, 2, 30}, {1, 4, 34});
  Views one;
  Views both;
  for (const Rational3& from : {Rational3{500, 0, 0}, Rational3{0, 500, 0}}) {
    one.push_back(view_of(towards_origin(from), large));
    both.push_back(one.back());
    both.back().second.push_back(view_of(towards_origin(from), small).second[0]);
  }
  const Result alone = compute(scene_of(one, cube(100)), {}, {});
  CHECK(alone.pieces.empty());
  const Result two = compute(scene_of(both, cube(100)), {}, {});
  REQUIRE(two.pieces.size() == 2);
  CHECK(two.pieces[0] == Approx(nef::approximate_volume(alone.hull).value));
  CHECK(two.pieces[0] + two.pieces[1] == Approx(nef::approximate_volume(two.hull).value));
  Options options;
  options.largest = true;
  options.verify = true;
  const Result kept = compute(scene_of(both, cube(100)), {}, options);
  CHECK(nef::equal(kept.hull, alone.hull));
  CHECK(kept.pieces == two.pieces);
  CHECK(kept.views[0].verification->inside);
}

TEST_CASE("Without a box it is found, and changes nothing") {
  const std::vector<Rational3> corners = box_corners({-10, -4, -7}, {9, 10, 8});
  const Views views{view_of(towards_origin({100, 3, 7}), corners), view_of(towards_origin({0, 120, 2}), corners)};
  Scene scene = scene_of(views, cube(60));
  const Result boxed = compute(scene, {}, {});
  scene.box.reset();
  const Result found = compute(scene, {}, {});
  CHECK(found.box_found);
  CHECK(nef::equal(found.hull, boxed.hull));
  scene.views.pop_back();
  CHECK_THROWS_WITH(compute(scene, {}, {}), Catch::Contains("give a box with --box"));
}

TEST_CASE("Verification is exact about inside and measures the rest") {
  const std::vector<Rational3> corners = box_corners({-10, -10, -10}, {10, 10, 10});
  const Camera camera = towards_origin({50, 0, 0});
  const Silhouette silhouette = convex_silhouette(camera, corners);  // half-width 10/40
  const nef::Polyhedron box = nef::make_box({-10, -10, -10}, {10, 10, 10});
  const Verification good = verify_view(box, camera, silhouette);
  CHECK(good.inside);
  CHECK(good.silhouette_area == Approx(0.25).epsilon(1e-3));
  CHECK(good.difference_area == Approx(0).margin(1e-4));
  const Verification small = verify_view(nef::make_box({-10, -10, -10}, {10, 10, 0}), camera, silhouette);
  CHECK(small.inside);
  CHECK(small.difference_area == Approx(0.125).epsilon(1e-2));
  // A hair too large is outside.
  const Rational hair(1, Integer("1000000000000000000000000000000"));
  const Verification large = verify_view(nef::make_box({-10, -10, -10}, {10, 10 + hair, 10}), camera, silhouette);
  CHECK_FALSE(large.inside);
  // A hole that the hull covers though no edge is seen in it.
  const Silhouette holed = make_silhouette({silhouette.rings[0], rectangle(-0.1, -0.1, 0.1, 0.1)}, "");
  const Verification covered = verify_view(box, camera, holed);
  CHECK_FALSE(covered.inside);
  CHECK(covered.problem.find("hole") != std::string::npos);
  CHECK(covered.difference_area == Approx(0.04).epsilon(1e-2));
  const Verification behind = verify_view(nef::make_box({60, 0, 0}, {61, 1, 1}), camera, silhouette);
  CHECK_FALSE(behind.inside);
}

TEST_CASE("Verification tells what runs along a side of the silhouette from what goes on behind its end") {
  // An L, seen from the origin at depth 1, where boxes have their front; behind it they are seen smaller.
  const Camera camera = axis_camera({0, 0, 0}, 2, 1);
  const Silhouette silhouette = make_silhouette({testing::ring({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})}, "L");
  const auto inside = [&](const Rational& x0, const Rational& y0, const Rational& x1, const Rational& y1) {
    return verify_view(nef::make_box({x0, y0, 1}, {x1, y1, Rational(11, 10)}), camera, silhouette).inside;
  };
  const Rational hair(1, Integer("1000000000000000000000000000000"));
  CHECK(inside(0, 0, 2, 1));
  CHECK(inside(0, 0, 1, 2));
  CHECK(inside(0, 0, 1, 1));
  CHECK(inside(Rational(1, 3), 0, Rational(5, 3), Rational(1, 3)));
  CHECK(inside(Rational(1, 3), 0, Rational(5, 3), 1 - hair));
  CHECK_FALSE(inside(0, 0, 2, 1 + hair));
  CHECK_FALSE(inside(0, 0, 2 + hair, 1));
  CHECK_FALSE(inside(0, 0, 1 + hair, 2));
  CHECK_FALSE(inside(-hair, 0, 1, 2));
  CHECK_FALSE(inside(0, 0, 2, 2));
  CHECK_FALSE(inside(1, 1, 2, 2));
  CHECK_FALSE(inside(1, 1, Rational(3, 2), Rational(3, 2)));
  CHECK_FALSE(inside(Rational(1, 2), 0, Rational(3, 2), Rational(3, 2)));
}

TEST_CASE("Random masks from three sides: the hull verifies in every view") {
  testing::property("inside everywhere, and nothing but what all views see is missing", [] {
    Views views;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Rational3 centre;
      centre[axis] = -40;
      const cv::Mat mask = testing::random_mask(10, 10, 1, *rc::gen::arbitrary<std::uint64_t>());
      if (cv::countNonZero(mask) == 0) RC_DISCARD();
      Silhouette traced = trace_contours(mask, PixelOrigin::kCorner);
      for (Ring& ring : traced.rings) {
        for (Point2& p : ring) p = Point2((p.x() - 5) / 20, (p.y() - 5) / 20);
      }
      views.emplace_back(axis_camera(centre, axis, 1, std::to_string(axis)), traced.rings);
    }
    Options options;
    options.verify = true;
    const Result result = compute(scene_of(views, cube(15)), {}, options);
    RC_ASSERT(nef::validate(result.hull.complex()) == "");
    for (const ViewResult& view : result.views) {
      if (view.verification) RC_ASSERT(view.verification->problem == "");
    }
    // Membership is that of the projections.
    for (int k = 0; k < 30; ++k) {
      const auto c = rc::gen::inRange(-60, 61);
      const Rational3 p{Rational(*c) / 4, Rational(*c) / 4, Rational(*c) / 4};
      bool seen = true;
      for (const ViewResult& view : result.views) {
        const Projection q = view.camera.project(p);
        seen = seen && locate(view.silhouette.region, Point2(q.x / q.depth, q.y / q.depth)) != Side::kOutside;
      }
      RC_ASSERT(nef::contains(result.hull, p) == seen);
    }
  });
}

}  // namespace
}  // namespace nef::visual_hull
