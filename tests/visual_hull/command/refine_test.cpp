// SPDX-License-Identifier: Apache-2.0
//
// --refine as a user runs it, and the scene that it writes.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/visual_hull/formats/write_scene.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/io/file_bytes.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/refine/rendered.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;
using testing::Outcome;
using testing::run;
using testing::Scratch;

// A folder with masks of a rendered object and a scene of cameras that are half a degree and five pixels off.
void write_disturbed_set(const fs::path& folder, const std::string& subfolder) {
  const testing::Set set = testing::rendered_set(testing::generic_object(8), testing::ring(10, false));
  const std::vector<testing::Shot> given = testing::disturbed(set.truth, 0.5, 5, 1.01, 4);
  fs::create_directories(folder / subfolder);
  Scene scene;
  for (std::size_t i = 0; i < given.size(); ++i) {
    View view = make_view("shot " + std::to_string(i), given[i].matrix());
    view.image = fs::path(subfolder) / (std::to_string(i) + ".png");
    cv::imwrite((folder / view.image).string(), set.masks[i]);
    scene.views.push_back(view);
  }
  nef::write_file((folder / "scene.json").string(), write_scene_json(scene));
}

TEST_CASE("The hull of a refined scene is that of the run that wrote it, byte for byte") {
  const Scratch scratch;
  const fs::path& folder = scratch.folder();
  write_disturbed_set(folder, "pictures");
  const std::string first = (folder / "first.nef").string();
  const std::string second = (folder / "second.nef").string();
  const std::string refined = (folder / "elsewhere" / "refined.json").string();
  fs::create_directories(folder / "elsewhere");
  const std::string report = (folder / "report.json").string();
  const Outcome made = run((folder / "scene.json").string() + " --refine --simplify 1 --refined-scene " + refined +
                           " -o " + first + " --report " + report);
  INFO(made.output);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.output, Contains("cameras refined (views)"));
  const nlohmann::json r = nlohmann::json::parse(nef::read_file(report));
  CHECK(r["refine"]["accepted"] == true);
  CHECK(r["refine"]["model"] == "views");
  CHECK(r["refine"]["residual_px_before"].get<double>() > 10 * r["refine"]["residual_px_after"].get<double>());
  CHECK(r["refine"]["held_out_px_before"].get<double>() > 10 * r["refine"]["held_out_px_after"].get<double>());
  CHECK(r["refine"]["views"].size() == 10);
  CHECK(r["refine"]["views"][3]["view"] == "shot 3");
  CHECK(r["refine"]["undetermined"].is_array());
  CHECK(r["phases"].contains("refine_s"));
  const Outcome again = run(refined + " --simplify 1 -o " + second);
  INFO(again.output);
  REQUIRE(again.code == 0);
  CHECK(nef::read_file(first) == nef::read_file(second));
  // What is refined already stays.
  const Outcome third = run(refined + " --refine --simplify 1 -o " + second);
  CHECK_THAT(third.output, Contains("cameras not refined"));
  CHECK(nef::read_file(first) == nef::read_file(second));
}

TEST_CASE("A folder of masks of a turntable becomes a hull without any camera") {
  const Scratch scratch;
  const testing::Set set = testing::rendered_set(testing::generic_object(8), testing::ring(8, true));
  const fs::path masks = scratch.folder() / "masks";
  fs::create_directories(masks);
  for (std::size_t i = 0; i < set.masks.size(); ++i) {
    cv::imwrite((masks / (std::to_string(i) + ".png")).string(), set.masks[i]);
  }
  const std::string first = (scratch.folder() / "first.nef").string();
  const std::string second = (scratch.folder() / "second.nef").string();
  const std::string refined = (scratch.folder() / "refined.json").string();
  const Outcome made = run(masks.string() + " --turntable 8 --refine --simplify 1 -o " + first + " --refined-scene " +
                           refined + " --verify");
  INFO(made.output);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.output, Contains("cameras found (turntable)"));
  const Outcome again = run(refined + " --simplify 1 -o " + second);
  REQUIRE(again.code == 0);
  CHECK(nef::read_file(first) == nef::read_file(second));
  const Outcome without = run(masks.string() + " --turntable 8");
  CHECK(without.code == 2);
  CHECK_THAT(without.output, Contains("or --refine to find it"));
}

TEST_CASE("A scene is read back as the numbers that were written") {
  const Scratch scratch;
  Scene scene;
  View plain = make_view("a \"name\"", testing::ring(3, false)[1].matrix());
  plain.image = "images/a b.png";
  plain.distortion.coefficients = {0.1, -0.02, 1e-5, 0};
  plain.distortion.intrinsics = {{{500, 0, Rational(1, 3)}, {0, 501, 0.1}, {0, 0, 1}}};
  scene.views.push_back(plain);
  View polygons;
  polygons.name = "polygons";
  polygons.camera = testing::axis_camera({Rational(1, 3), 0, -5}, 2, 1, "polygons");
  polygons.polygons = std::vector<Ring>{{Point2(Rational(1, 7), 0), Point2::from_doubles(0.1, 1e-20), Point2(1, 1)}};
  scene.views.push_back(polygons);
  scene.origin = PixelOrigin::kCorner;
  scene.box = WorldBox{{-1, Rational(-2, 3), -0.1}, {1, 2, 3}};
  scene.threshold = ThresholdOptions{ThresholdOptions::Kind::kValue, 0.3, true, ThresholdOptions::Channel::kRedBlue};
  const fs::path file = scratch.folder() / "scene.json";
  nef::write_file(file.string(), write_scene_json(scene));
  const Scene read = read_scene(file);
  REQUIRE(read.views.size() == 2);
  CHECK(read.ignored.empty());
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(read.views[i].name == scene.views[i].name);
    CHECK(read.views[i].camera.matrix() == scene.views[i].camera.matrix());
  }
  CHECK(read.views[0].image == plain.image);
  CHECK(read.views[0].distortion.coefficients == plain.distortion.coefficients);
  CHECK(read.views[0].distortion.intrinsics == plain.distortion.intrinsics);
  REQUIRE(read.views[1].polygons);
  CHECK(*read.views[1].polygons == *polygons.polygons);
  CHECK(read.origin == PixelOrigin::kCorner);
  REQUIRE(read.box);
  CHECK(read.box->low == scene.box->low);
  CHECK(read.box->high == scene.box->high);
  REQUIRE(read.threshold);
  CHECK(read.threshold->kind == ThresholdOptions::Kind::kValue);
  CHECK(read.threshold->value == 0.3);
  CHECK(read.threshold->invert);
  CHECK(read.threshold->channel == ThresholdOptions::Channel::kRedBlue);
}

TEST_CASE("What --refine needs is said in one line") {
  const std::string scene = source_folder() + "/data/visual_hull/letters/nef.vsh";
  const Outcome alone = run(scene + " --refined-scene x.json");
  CHECK(alone.code == 2);
  CHECK_THAT(alone.output, Contains("--refine"));
  const Outcome frames = run(scene + " --refine --frames 'f%d' -o 'h%d.off'");
  CHECK(frames.code == 2);
  CHECK_THAT(frames.output, Contains("--refine is for one hull, not for --frames"));
}

}  // namespace
}  // namespace nef::visual_hull
