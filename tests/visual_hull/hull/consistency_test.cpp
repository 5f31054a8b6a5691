// SPDX-License-Identifier: Apache-2.0
//
// Which view is wrong, on rendered sets of which one mask is damaged; and which views have no point in common.
#include <algorithm>
#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/silhouette/contour.h"
#include "apps/visual_hull/verify/empty_hull.h"
#include "apps/visual_hull/verify/sight_lines.h"
#include "nef/base/error.h"
#include "nef/polyhedron.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using testing::axis_camera;
using testing::cube;
using testing::rectangle;
using testing::scene_of;
using testing::Scratch;

// A shipped set whose masks are copied, so that one of them can be damaged.
class Copy {
 public:
  explicit Copy(const std::string& model) : scene_(read_scene(source(model) / (model + ".json"))) {
    for (const View& view : scene_.views) {
      std::filesystem::copy_file(source(model) / view.image, folder_.folder() / view.image);
    }
  }

  static std::filesystem::path source(const std::string& model) {
    return std::filesystem::path(source_folder()) / "data/visual_hull" / model;
  }
  [[nodiscard]] std::string file(std::size_t view) const {
    return (folder_.folder() / scene_.views[view].image).string();
  }
  [[nodiscard]] cv::Mat mask(std::size_t view) const { return cv::imread(file(view), cv::IMREAD_GRAYSCALE) > 127; }
  void damage(std::size_t view, const cv::Mat& mask) const { cv::imwrite(file(view), mask); }

  [[nodiscard]] Result compare(bool drop = false) const {
    Options options;
    options.silhouette.simplify.tolerance = 1;
    options.suspects = true;
    options.drop_suspects = drop;
    return compute(scene_, folder_.folder(), options);
  }

 private:
  Scene scene_;
  Scratch folder_;
};

cv::Mat shifted(const cv::Mat& mask, double du, double dv) {
  const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, du, 0, 1, dv);
  cv::Mat result;
  cv::warpAffine(mask, result, move, mask.size(), cv::INTER_NEAREST);
  return result;
}

// Without the lowest part of the silhouette, a share of its area.
cv::Mat cut(cv::Mat mask, double share) {
  const int keep = static_cast<int>((1 - share) * cv::countNonZero(mask));
  int seen = 0;
  for (int y = 0; y < mask.rows; ++y) {
    if (seen >= keep) mask.row(y).setTo(0);
    seen += cv::countNonZero(mask.row(y));
  }
  return mask;
}

TEST_CASE("A line of sight is cut where its points are seen in the silhouette") {
  cv::RNG rng(11);
  const auto random = [&rng](double size) { return rng.uniform(-size, size); };
  std::size_t seen = 0;
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Matrix34 matrix;
    for (std::size_t i = 0; i < 3; ++i) {
      const double size = i < 2 ? 20 : 1;
      for (std::size_t j = 0; j < 4; ++j) matrix[i][j] = nef::exact_rational(random(size));
    }
    const Camera camera("c", matrix);
    const Silhouette silhouette =
        trace_contours(testing::random_mask(40, 30, 2, seed), PixelOrigin::kCenter, DiagonalPixels::kTouch);
    const SightView view(ComparedView{&camera, &silhouette});
    const Eigen::Vector3d centre(random(3), random(3), random(3));
    const SightPencil pencil(view, centre);
    for (int line = 0; line < 30; ++line) {
      const Eigen::Vector3d direction(random(1), random(1), random(1));
      const DepthInterval range{rng.uniform(0.0, 1.0), rng.uniform(1.0, 9.0)};
      std::vector<double> ends;
      pencil.cut(direction, range, ends);
      REQUIRE(ends.size() % 2 == 0);
      CHECK(std::is_sorted(ends.begin(), ends.end()));
      for (int k = 0; k < 30; ++k) {
        const double s = rng.uniform(range.from, range.to);
        const auto near = [s](double end) { return std::abs(end - s) < 1e-6; };
        if (std::any_of(ends.begin(), ends.end(), near)) continue;
        const Eigen::Vector3d x = centre + s * direction;
        const Projection p =
            camera.project({nef::exact_rational(x[0]), nef::exact_rational(x[1]), nef::exact_rational(x[2])});
        const bool inside =
            sgn(p.depth) > 0 && locate(silhouette, Point2(p.x / p.depth, p.y / p.depth)) == Side::kInside;
        const auto before = std::lower_bound(ends.begin(), ends.end(), s) - ends.begin();
        CHECK((before % 2 == 1) == inside);
        seen += inside ? 1 : 0;
        ++compared;
      }
    }
  }
  CHECK(seen > 1000);
  CHECK(compared > 30000);
}

TEST_CASE("No view of a clean set is accused") {
  for (const std::string model : {"elk", "eight"}) {
    const Result result = Copy(model).compare();
    REQUIRE(result.consistency.has_value());
    CHECK_FALSE(result.consistency->guilty.has_value());
    CHECK(result.dropped.empty());
  }
}

TEST_CASE("The damaged view is named, and leaving it out brings the hull back") {
  for (const std::string model : {"elk", "eight"}) {
    const Copy clean(model);
    const double volume = nef::nearest_double(*nef::volume(clean.compare().hull));
    for (const std::size_t view : {std::size_t{2}, std::size_t{7}}) {
      INFO(model << " " << view);
      Copy copy(model);
      copy.damage(view, shifted(copy.mask(view), 5, 0));
      const Result shift = copy.compare();
      CHECK(shift.consistency->guilty == view);
      copy.damage(view, cut(clean.mask(view), 0.2));
      const Result lost = copy.compare();
      CHECK(lost.consistency->guilty == view);
      // Its own residual is small: it is the others that are not covered any more.
      CHECK(lost.consistency->share(view) > 0.5);
      const Result mended = copy.compare(true);
      REQUIRE(mended.dropped.size() == 1);
      CHECK(mended.dropped[0].view == clean.compare().views[view].name);
      CHECK(mended.views.size() == 11);
      const double before = nef::nearest_double(*nef::volume(lost.hull));
      const double after = nef::nearest_double(*nef::volume(mended.hull));
      CHECK(before < 0.9 * volume);
      CHECK(after == Approx(volume).epsilon(0.05));
    }
  }
}

TEST_CASE("The comparison does not depend on the number of threads", "[threads]") {
  const Copy copy("elk");
  copy.damage(3, shifted(copy.mask(3), 4, 3));
  const Result one = copy.compare();
  std::vector<ComparedView> views;
  for (const ViewResult& view : one.views) views.push_back({&view.camera, &view.silhouette.region});
  const Consistency two = compare_views(views, one.box, nef::Monitor().on_threads(2));
  REQUIRE(two.views.size() == one.consistency->views.size());
  for (std::size_t i = 0; i < two.views.size(); ++i) {
    CHECK(two.views[i].score == one.consistency->views[i].score);
    CHECK(two.views[i].removed == one.consistency->views[i].removed);
  }
}

TEST_CASE("A view that the frame cuts is compared and not accused") {
  const Copy copy("elk");
  copy.damage(3, shifted(copy.mask(3), 8, 6));
  const Result seen = copy.compare();
  REQUIRE(seen.consistency->guilty == std::size_t{3});
  std::vector<ComparedView> views;
  for (const ViewResult& view : seen.views) views.push_back({&view.camera, &view.silhouette.region});
  views[3].cut_by_frame = true;
  const Consistency found = compare_views(views, seen.box, {});
  CHECK_FALSE(found.guilty.has_value());
  CHECK(found.ranked()[0] == 3);
  // A mask that runs to the border of its image is such a view.
  cv::Mat mask = copy.mask(3);
  mask.row(mask.rows / 2).setTo(255);
  copy.damage(3, mask);
  const Result cut = copy.compare();
  CHECK(cut.consistency->ranked()[0] == 3);
  CHECK_FALSE(cut.consistency->guilty.has_value());
}

// Known by arithmetic: three cameras far away on the axes, so that cones are nearly prisms, all seeing [-1, 1]^2 but
// for one that sees the half x < 0 of it. What it alone rejects is half of the cube.
TEST_CASE("Volumes that one view alone rejects") {
  const double far = 1000;
  const Rational r(1000);
  const Ring square = rectangle(-1 / far, -1 / far, 1 / far, 1 / far);
  const Camera along_x = axis_camera({-r, 0, 0}, 0, 1, "x");
  const Camera along_y = axis_camera({0, -r, 0}, 1, 1, "y");
  const Camera along_z = axis_camera({0, 0, -r}, 2, 1, "z");
  const Silhouette all = make_silhouette({square}, "all");
  const Silhouette half = make_silhouette({rectangle(-1 / far, -1 / far, 0, 1 / far)}, "half");
  const std::vector<ComparedView> views{{&along_x, &all}, {&along_y, &all}, {&along_z, &half}};
  const Consistency found = compare_views(views, cube(2), {});
  CHECK(found.views[2].removed == Approx(4).epsilon(0.05));
  // Along x every line of sight meets the half that is left, along y every second one.
  CHECK(found.views[0].residual == Approx(0).margin(0.01));
  CHECK(found.views[1].residual == Approx(0.5).epsilon(0.05));
  CHECK(found.views[2].residual == Approx(0).margin(0.01));
  CHECK(found.views[2].fall == Approx(0.5).epsilon(0.05));
}

TEST_CASE("Smallest sets of views without a common point") {
  const Ring square = rectangle(-0.25, -0.25, 0.25, 0.25);
  const Ring aside = rectangle(0.75, -0.25, 1.25, 0.25);
  const Camera a = axis_camera({-10, 0, 0}, 0, 1, "a");
  const Camera b = axis_camera({0, -10, 0}, 1, 1, "b");
  const Camera c = axis_camera({0, 0, -10}, 2, 1, "c");
  const Silhouette middle = make_silhouette({square}, "middle");
  const Silhouette away = make_silhouette({aside}, "away");
  const std::vector<ComparedView> views{{&a, &middle}, {&b, &middle}, {&c, &away}};
  const auto sets = views_without_common_point(views, cube(20), 5, {});
  REQUIRE_FALSE(sets.empty());
  for (const auto& set : sets) {
    CHECK(set.size() == 2);
    CHECK(set.back() == 2);  // it is the third that looks elsewhere
  }
  const std::vector<ComparedView> agreeing{{&a, &middle}, {&b, &middle}, {&c, &middle}};
  CHECK(views_without_common_point(agreeing, cube(20), 5, {}).empty());

  const Result empty = compute(scene_of({{a, {square}}, {b, {square}}, {c, {aside}}}, cube(20)), {}, {});
  REQUIRE(empty.vanished.has_value());
  REQUIRE_FALSE(empty.vanished->sets.empty());
  CHECK(empty.vanished->sets[0].size() == 2);
  CHECK(empty.vanished->reason.find("have no point in common") != std::string::npos);
}

TEST_CASE("Points in at least so many silhouettes") {
  // Three boxes in a row, seen by three cameras far off: x in [0, 2], [1, 3], [2, 4] on the same cross-section.
  const Ring left = rectangle(0, 0, 2, 1);
  const Camera camera = axis_camera({0, 0, -10}, 2, 1, "z");
  const auto views = [&](double from) {
    return std::pair<Camera, std::vector<Ring>>{camera, {rectangle(from, 0, from + 2, 1)}};
  };
  const Scene scene = scene_of({views(0), views(1), views(2)}, WorldBox{{-5, -5, -10}, {50, 50, 0}});
  Options options;
  std::vector<nef::Polyhedron> hulls;
  for (const std::size_t least : {1, 2, 3}) {
    options.at_least = least;
    hulls.push_back(compute(scene, {}, options).hull);
    CHECK(nef::validate(hulls.back().complex()) == "");
  }
  // Of the pyramid over a unit of width: a third of the height 10 times the base 100.
  const Rational unit(1000, 3);
  CHECK(nef::volume(hulls[0]).value() == 4 * unit);
  CHECK(nef::volume(hulls[1]).value() == 2 * unit);
  options.at_least.reset();
  CHECK(nef::equal(hulls[2], compute(scene, {}, options).hull));
  CHECK(nef::contains(hulls[2], {20, 5, 0}));  // the facet where the first and the third meet
  options.at_least = 4;
  CHECK_THROWS_AS(compute(scene, {}, options), nef::InputError);
}

TEST_CASE("Points in at least so many silhouettes need no box where groups of views have one") {
  testing::property("the same set as in a large box", [] {
    std::vector<std::pair<Camera, std::vector<Ring>>> views;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int direction : {1, -1}) {
        Rational3 centre{*rc::gen::inRange(-1, 2), *rc::gen::inRange(-1, 2), *rc::gen::inRange(-1, 2)};
        centre[axis] = -10 * direction;
        const double x = *rc::gen::inRange(-3, 2) / 8.0;
        const double y = *rc::gen::inRange(-3, 2) / 8.0;
        const double size = *rc::gen::inRange(1, 4) / 8.0;
        views.emplace_back(axis_camera(centre, axis, direction, std::to_string(views.size())),
                           std::vector<Ring>{rectangle(x, y, x + size, y + size)});
      }
    }
    Scene scene = scene_of(views, cube(60));
    Options options;
    options.at_least = *rc::gen::inRange<std::size_t>(5, 7);
    const Result boxed = compute(scene, {}, options);
    scene.box.reset();
    const Result found = compute(scene, {}, options);
    RC_ASSERT(found.box_found);
    RC_ASSERT(nef::equal(found.hull, boxed.hull));
  });
  // Groups that are too small to have a box.
  Options options;
  options.at_least = 2;
  const Camera z = axis_camera({0, 0, -10}, 2, 1, "z");
  Scene scene = scene_of({{z, {rectangle(0, 0, 1, 1)}}, {z, {rectangle(0, 0, 2, 1)}}}, cube(1));
  scene.box.reset();
  CHECK_THROWS_WITH(compute(scene, {}, options), Catch::Contains("do not bound the scene: give a box"));
}

}  // namespace
}  // namespace nef::visual_hull
