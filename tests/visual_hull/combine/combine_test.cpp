// SPDX-License-Identifier: Apache-2.0
//
// Two series of a rendered object that was turned over in between: where the second one is placed, and that the hull of
// the combined scene is the intersection of both hulls.
#include "apps/visual_hull/combine/combine.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/visual_hull/formats/write_scene.h"
#include "nef/io/file_bytes.h"
#include "nef/polyhedron.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/refine/camera_difference.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;
using testing::generic_object;
using testing::Outcome;
using testing::run;
using testing::Scratch;
using testing::Shot;

const Eigen::Matrix3d kTurned =
    Eigen::AngleAxisd(1.9, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();  // 109 degrees

// A turntable, with the camera above.
std::vector<Shot> table(int count) { return testing::ring(count, true); }

// The same cameras around an object that was turned over: x = R (turn X + shift) + t.
std::vector<Shot> turned(std::vector<Shot> shots) {
  for (Shot& shot : shots) {
    shot.t += shot.r * Eigen::Vector3d(0.05, -0.1, 0.02);
    shot.r = shot.r * kTurned;
  }
  return shots;
}

OutlineSeries series_of(const testing::Set& set, const std::vector<Shot>& cameras) {
  OutlineSeries series;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    series.cameras.emplace_back(cameras[i].k, cameras[i].r, cameras[i].t);
    series.outlines.push_back(refine::make_outline(set.silhouettes[i], {}, {}, PixelOrigin::kCenter, 150));
  }
  return series;
}

// By how many pixels a placed series sees the object elsewhere than it did (root mean square).
double off_by(const Placement& placement, const std::vector<Shot>& cameras, const std::vector<Shot>& truth) {
  const std::vector<Eigen::Vector3d> points = refine::ball_points({0, 0, 0}, testing::kObjectRadius);
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const refine::MovingCamera placed = placed_camera({cameras[i].k, cameras[i].r, cameras[i].t}, placement);
    const double d = refine::image_distance(placed, {truth[i].k, truth[i].r, truth[i].t}, points);
    sum += d * d / static_cast<double>(truth.size());
  }
  return std::sqrt(sum);
}

TEST_CASE("A series of an object that was turned over is placed within .3 pixels of the truth, in any unit") {
  const auto object = generic_object(4);
  const testing::Set upright = testing::rendered_set(object, table(5));
  const testing::Set lying = testing::rendered_set(object, turned(table(5)));
  std::vector<Shot> given = table(5);  // the space of the second series is that of its turntable
  for (Shot& shot : given) shot.t *= 1.4;
  const Placement placement = place_series(series_of(upright, table(5)), series_of(lying, given), {});
  INFO(off_by(placement, given, lying.truth)
       << " px off, outlines " << placement.together_px << " instead of " << placement.alone_px << ", next best "
       << placement.runner_up_px << " after " << placement.best_found_px);
  CHECK(off_by(placement, given, lying.truth) < 0.3);
  CHECK(placement.fits());
  CHECK_FALSE(placement.ambiguous());
  CHECK(placement.scaled);
  CHECK(placement.map.scale == Approx(1.4).epsilon(0.002));
  CHECK(placement.to_first().scale == Approx(1 / 1.4).epsilon(0.002));
  CHECK(placement.together_px < placement.alone_px + 0.1);
}

// A scene file with masks beside it.
std::string write_series(const fs::path& folder, const std::string& name, const testing::Set& set,
                         const std::vector<Shot>& cameras) {
  fs::create_directories(folder / name);
  Scene scene;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    View view = make_view(std::to_string(i), cameras[i].matrix());
    view.image = fs::path(name) / (std::to_string(i) + ".png");
    cv::imwrite((folder / view.image).string(), set.masks[i]);
    scene.views.push_back(view);
  }
  std::string file = (folder / (name + ".json")).string();
  nef::write_file(file, write_scene_json(scene));
  return file;
}

Options simplified() {
  Options options;
  options.silhouette.simplify.tolerance = 1;
  return options;
}

TEST_CASE("The hull of a combined scene is the intersection of the hulls of its series, and nearer to the object") {
  const Scratch scratch;
  const auto object = generic_object(3);
  const std::string upright =
      write_series(scratch.folder(), "upright", testing::rendered_set(object, table(5)), table(5));
  const std::string lying =
      write_series(scratch.folder(), "lying", testing::rendered_set(object, turned(table(5))), table(5));
  const std::string both = (scratch.folder() / "both.json").string();
  const std::string report = (scratch.folder() / "report.json").string();
  const Outcome made = run("combine " + upright + " " + lying + " -o " + both + " --report " + report);
  INFO(made.output);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.output, Contains("lying.json: 5 views, turned by 108.8"));
  const nlohmann::json series = nlohmann::json::parse(nef::read_file(report))["series"][0];
  CHECK(series["fits"] == true);
  CHECK(series["scale"] == 1);
  CHECK(series["views"] == 5);

  Scene scene = read_scene(both);
  REQUIRE(scene.views.size() == 10);
  CHECK(scene.views[5].name == "2_0");
  CHECK(scene.views[0].camera.matrix() == read_scene(upright).views[0].camera.matrix());
  const Result together = compute(scene, scratch.folder(), simplified());
  Scene first = scene;
  first.views.resize(5);
  scene.views.erase(scene.views.begin(), scene.views.begin() + 5);
  const Polyhedron a = compute(first, scratch.folder(), simplified()).hull;
  const Polyhedron b = compute(scene, scratch.folder(), simplified()).hull;
  CHECK(nef::equal(together.hull, nef::intersect(a, b)));
  const double volume = nef::approximate_volume(together.hull).value;
  CHECK(volume < 0.97 * nef::approximate_volume(a).value);
  CHECK(volume < 0.97 * nef::approximate_volume(b).value);
}

TEST_CASE("Series that do not fit each other are refused, and nothing is written") {
  const Scratch scratch;
  const std::string one =
      write_series(scratch.folder(), "one", testing::rendered_set(generic_object(3), table(5)), table(5));
  const std::string other =
      write_series(scratch.folder(), "other", testing::rendered_set(generic_object(6), table(5)), table(5));
  const std::string both = (scratch.folder() / "both.json").string();
  const Outcome refused = run("combine " + one + " " + other + " -o " + both);
  CHECK(refused.code == 1);
  CHECK_THAT(refused.output, Contains("other.json: no place found"));
  CHECK_FALSE(fs::exists(both));
  const Outcome single = run("combine " + one + " -o " + both);
  CHECK(single.code == 2);
  CHECK_THAT(single.output, Contains("two scenes at least"));
}

}  // namespace
}  // namespace nef::visual_hull
