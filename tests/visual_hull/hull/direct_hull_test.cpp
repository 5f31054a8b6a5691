// SPDX-License-Identifier: Apache-2.0
//
// The direct way to the hull gives what intersecting the cones gives, or nothing.
#include "apps/visual_hull/viewing_edges/direct_hull.h"

#include "apps/visual_hull/cones/bounds.h"
#include "apps/visual_hull/cones/intersection.h"
#include "nef/polyhedron.h"
#include "tests/support/numbers/magnitudes.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using testing::axis_camera;
using testing::random_mask;

struct TestView {
  Camera camera;
  Silhouette silhouette;
};

std::optional<WorldBox> enclosing_box(const std::vector<TestView>& views) {
  std::vector<HalfSpace> half_spaces;
  for (const TestView& view : views) {
    const std::vector<HalfSpace> cone = convex_cone(view.camera, view.silhouette);
    half_spaces.insert(half_spaces.end(), cone.begin(), cone.end());
  }
  const Bounds bounds = bounds_of(half_spaces);
  if (bounds.kind != Bounds::Kind::kBox) return std::nullopt;
  return loosen(bounds.box);
}

std::optional<nef::Polyhedron> directly(const std::vector<TestView>& views, const WorldBox& box) {
  std::vector<DirectView> inputs;
  for (const TestView& view : views) inputs.push_back({&view.camera, &view.silhouette});
  return direct_hull(inputs, box, {});
}

nef::Polyhedron by_cones(const std::vector<TestView>& views, const WorldBox& box) {
  std::vector<Part> parts;
  for (const TestView& view : views) parts.push_back({make_cone(view.camera, view.silhouette, box), {}});
  parts.push_back({nef::make_box(box.low, box.high), {}});
  return intersect_parts(parts);
}

// A mask of s x s pixels as seen from a camera on an axis, turned a little so that nothing is in special position.
TestView view_of_mask(std::size_t axis, int direction, const cv::Mat& mask, int skew) {
  Rational3 centre;
  for (std::size_t i = 0; i < 3; ++i) centre[i] = Rational(skew * static_cast<int>(i + 2), 97);
  centre[axis] = -40 * direction + Rational(skew, 89);
  TestView seen{axis_camera(centre, axis, direction, "view"), trace_contours(mask, PixelOrigin::kCorner)};
  for (Ring& ring : seen.silhouette.rings) {
    for (Point2& p : ring) {
      const Rational u = (p.x() - Rational(mask.cols, 2)) / 20;
      const Rational v = (p.y() - Rational(mask.rows, 2)) / 20;
      p = Point2(u + v * Rational(skew, 1009), v + u * Rational(skew, 2003));
    }
  }
  return seen;
}

// How often the direct way was asked, and how often it answered, each time like the cones.
struct Compared {
  std::size_t asked = 0;
  std::size_t used = 0;

  void add(const std::vector<TestView>& views) {
    const std::optional<WorldBox> box = enclosing_box(views);
    if (!box) return;
    ++asked;
    const std::optional<nef::Polyhedron> hull = directly(views, *box);
    if (!hull) return;
    ++used;
    RC_ASSERT(nef::validate(hull->complex()) == "");
    RC_ASSERT(nef::equal(*hull, by_cones(views, *box)));
  }
};

TEST_CASE("Random masks, holes and touching rings included: the direct way agrees with the cones") {
  Compared compared;
  testing::property("equal where it answers", [&] {
    std::vector<TestView> views;
    const int smoothing = *rc::gen::inRange(0, 2);
    const std::size_t count = *rc::gen::inRange<std::size_t>(3, 6);
    for (std::size_t i = 0; i < count; ++i) {
      const cv::Mat mask = random_mask(7, 7, smoothing, *rc::gen::arbitrary<std::uint64_t>());
      if (cv::countNonZero(mask) == 0) RC_DISCARD();
      views.push_back(view_of_mask(i % 3, i < 3 ? 1 : -1, mask, *rc::gen::inRange(1, 200)));
    }
    compared.add(views);
  });
  CHECK(5 * compared.used >= 3 * compared.asked);  // it is not there to give up
}

// A closed curve with bumps, and a hole in its middle if that is asked for.
Silhouette bumpy(std::size_t view, std::size_t vertices, bool hole) {
  std::vector<Ring> rings(hole ? 2 : 1);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < vertices; ++i) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(vertices);
      const double phase = 1.7 * static_cast<double>(view);
      const double radius = (r == 0 ? 180 : 40) + 22 * std::sin(5 * angle + phase) + 9 * std::sin(13 * angle - phase);
      rings[r].push_back(Point2::from_doubles(std::round(16 * radius * std::cos(angle)) / 16,
                                              std::round(16 * radius * std::sin(angle)) / 16));
    }
  }
  return make_silhouette(rings, "");
}

// At distance 10 on a spiral over the sphere, looking at the origin; its numbers have six decimals.
Camera spiral_camera(std::size_t index, std::size_t count) {
  const double z = 1 - (2 * static_cast<double>(index) + 1) / static_cast<double>(count);
  const double angle = 2.399963 * static_cast<double>(index);
  const double r = std::sqrt(1 - z * z);
  const std::array<std::array<double, 3>, 3> rows{{{-std::sin(angle), std::cos(angle), 0},
                                                   {-z * std::cos(angle), -z * std::sin(angle), r},
                                                   {-r * std::cos(angle), -r * std::sin(angle), -z}}};
  Matrix3 rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rotation[i][j] = Rational(std::lround(rows[i][j] * 1e6), 1000000);
  }
  const Matrix3 k{{{800, 0, 0}, {0, 800, 0}, {0, 0, 1}}};
  return Camera::from_parts(std::to_string(index), k, rotation, {0, 0, 10});
}

TEST_CASE("Many views, of many vertices or few, with holes or without: the direct way agrees with the cones") {
  for (const auto& [count, vertices] : {std::array<std::size_t, 2>{17, 40}, {24, 24}, {40, 9}}) {
    for (const bool hole : {false, true}) {
      std::vector<TestView> views;
      for (std::size_t i = 0; i < count; ++i) views.push_back({spiral_camera(i, count), bumpy(i, vertices, hole)});
      const WorldBox box = enclosing_box(views).value();
      const std::optional<nef::Polyhedron> hull = directly(views, box);
      REQUIRE(hull.has_value());
      CHECK(nef::validate(hull->complex()) == "");
      CHECK(nef::equal(*hull, by_cones(views, box)));
    }
  }
}

// A camera's matrix times a number is the same camera; a scene may be small or large, its images, too.
TEST_CASE("Matrices, scenes and images of any magnitude: the direct way gives up, or agrees", "[bounds]") {
  constexpr std::size_t kViews = 7;
  std::vector<TestView> views;
  for (std::size_t i = 0; i < kViews; ++i) views.push_back({spiral_camera(i, kViews), bumpy(i, 9, i % 2 == 1)});
  const WorldBox box = enclosing_box(views).value();
  const nef::Polyhedron expected = by_cones(views, box);
  std::size_t used = 0;
  for (const long exponent : nef::test::kExponents) {
    const Rational factor = nef::test::power_of_two(exponent);
    const auto times = [&](const Rational& matrix, const Rational& scene, const Rational& image) {
      std::vector<TestView> changed;
      for (const TestView& view : views) {
        Matrix34 m = view.camera.matrix();
        for (std::size_t row = 0; row < 3; ++row) {
          for (std::size_t k = 0; k < 4; ++k) {
            m[row][k] *= matrix;
            if (k == 3) m[row][k] *= scene;
            if (row < 2) m[row][k] *= image;
          }
        }
        Silhouette silhouette = view.silhouette;
        for (Ring& ring : silhouette.rings) {
          for (Point2& p : ring) p = Point2(p.x() * image, p.y() * image);
        }
        changed.push_back({Camera(view.camera.name(), m), silhouette});
      }
      const WorldBox large{nef::test::scaled(box.low, scene), nef::test::scaled(box.high, scene)};
      const std::optional<nef::Polyhedron> hull = directly(changed, large);
      if (!hull) return;
      ++used;
      CHECK(nef::equal(*hull, nef::test::scaled(expected, scene)));
    };
    INFO("times 2^" << exponent);
    times(factor, 1, 1);
    times(1, factor, 1);
    times(1, 1, factor);
    times(1 / factor, factor, 1);
  }
  CHECK(used > 20);
}

TEST_CASE("The views of a real scene go the direct way, on any number of threads", "[threads]") {
  const std::filesystem::path folder = source_folder() + "/data/visual_hull/elk";
  const Scene scene = read_scene(folder / "elk.json");
  Options options;
  options.silhouette.simplify.tolerance = 1;
  const Result direct = compute(scene, folder, options);
  CHECK(direct.direct);
  options.way = Way::kCones;
  const Result cones = compute(scene, folder, options);
  CHECK_FALSE(cones.direct);
  CHECK(nef::equal(direct.hull, cones.hull));
  options.way = Way::kBest;
  options.monitor = nef::Monitor().on_threads(3);
  const Result threads = compute(scene, folder, options);
  CHECK(nef::counts(threads.hull).vertices == nef::counts(direct.hull).vertices);
  CHECK(nef::equal(direct.hull, threads.hull));
}

// Nothing is turned: facets of several views lie in one plane, edges on one line, and vertices on many planes.
TEST_CASE("Views in degenerate position: the direct way agrees with the cones") {
  Compared compared;
  testing::property("random masks from along the axes", [&] {
    std::vector<TestView> views;
    const int smoothing = *rc::gen::inRange(0, 2);
    const bool alike = *rc::gen::arbitrary<bool>();
    const std::size_t count = *rc::gen::inRange<std::size_t>(3, 7);
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    for (std::size_t i = 0; i < count; ++i) {
      const cv::Mat mask = random_mask(6, 6, smoothing, alike ? seed : seed + i);
      if (cv::countNonZero(mask) == 0) RC_DISCARD();
      views.push_back(view_of_mask(i % 3, i < 3 ? 1 : -1, mask, 0));
    }
    compared.add(views);
  });
  CHECK(10 * compared.used >= 9 * compared.asked);
}

TEST_CASE("Views that share a camera, and cameras that share planes: the direct way agrees with the cones") {
  const cv::Mat full(7, 7, CV_8U, cv::Scalar(255));
  const std::vector<TestView> views{view_of_mask(0, 1, full, 3), view_of_mask(1, 1, full, 5),
                                    view_of_mask(2, 1, full, 7)};
  const auto agree = [](const std::vector<TestView>& seen) {
    const WorldBox box = enclosing_box(seen).value();
    const std::optional<nef::Polyhedron> hull = directly(seen, box);
    REQUIRE(hull.has_value());
    CHECK(nef::equal(*hull, by_cones(seen, box)));
  };
  std::vector<TestView> twice = views;
  twice.push_back(views[0]);
  agree(twice);
  twice.back().silhouette = make_silhouette({testing::rectangle(-0.1, -0.125, 0.15, 0.125)}, "");
  agree(twice);
  // Both see the plane z = 0 as an edge.
  const auto half = [](const Rational3& centre, std::size_t axis) {
    return TestView{
        axis_camera(centre, axis, 1),
        make_silhouette(
            {axis == 0 ? testing::rectangle(-0.25, 0, 0.25, 0.25) : testing::rectangle(0, -0.25, 0.25, 0.25)}, "")};
  };
  agree({half({-40, 0, 0}, 0), half({0, -40, 0}, 1), view_of_mask(2, 1, full, 7)});
}

TEST_CASE("A turntable: all cameras see a point of the axis in one place") {
  // Turns by exact angles about the z axis; the silhouette ends on it above and below, level with a row of pixels.
  const Matrix3 k{{{400, 0, 0}, {0, 400, 0}, {0, 0, 1}}};
  const std::vector<std::array<Rational, 2>> turns{
      {1, 0},  {Rational(3, 5), Rational(4, 5)},   {0, 1}, {Rational(-3, 5), Rational(4, 5)},
      {-1, 0}, {Rational(-4, 5), Rational(-3, 5)}, {0, -1}};
  for (const bool tip : {false, true}) {
    std::vector<TestView> views;
    for (const auto& [c, s] : turns) {
      const Matrix3 rotation{{{Rational(-s), c, 0}, {0, 0, -1}, {Rational(-c), Rational(-s), 0}}};
      const Ring outline = tip ? Ring{Point2(-30, 5), Point2(0, -40), Point2(30, 5), Point2(0, 45)}
                               : Ring{Point2(-30, -40), Point2(20, -40), Point2(25, 10), Point2(-20, 30)};
      views.push_back({Camera::from_parts("turned", k, rotation, {0, 0, 10}), make_silhouette({outline}, "")});
    }
    const WorldBox box = enclosing_box(views).value();
    const std::optional<nef::Polyhedron> hull = directly(views, box);
    REQUIRE(hull.has_value());
    CHECK(nef::validate(hull->complex()) == "");
    CHECK(nef::equal(*hull, by_cones(views, box)));
  }
}

TEST_CASE("What the direct way is not made for it leaves to the cones") {
  const cv::Mat full(7, 7, CV_8U, cv::Scalar(255));
  std::vector<TestView> views{view_of_mask(0, 1, full, 3), view_of_mask(1, 1, full, 5), view_of_mask(2, 1, full, 7)};
  const WorldBox box = enclosing_box(views).value();
  CHECK(directly(views, box).has_value());
  const std::vector<TestView> two(views.begin(), views.begin() + 2);
  CHECK_FALSE(directly(two, box).has_value());
  // A camera in the box.
  CHECK_FALSE(directly(views, {{-100, -100, -100}, {100, 100, 100}}).has_value());
}

}  // namespace
}  // namespace nef::visual_hull
