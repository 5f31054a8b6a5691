// SPDX-License-Identifier: Apache-2.0
//
// Masks of rendered photographs that are wrong in known ways: what the other views contradict is repaired, and what was
// right stays.
#include "apps/visual_hull/mask_repair/repair_masks.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/formats/write_scene.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/refine/rendered.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::generic_object;
using testing::Outcome;
using testing::render;
using testing::ring;
using testing::run;
using testing::Scratch;
using testing::Shot;

/// Photographs of a reddish object before a bluish wall, of which a part is nearly white.
struct Studio {
  std::vector<Shot> shots = ring(10, false);
  std::vector<cv::Mat> truth;
  std::vector<PhotographedView> views;

  explicit Studio(const Scratch& s) {
    const auto object = generic_object(4);
    cv::RNG random(3);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      truth.push_back(render(object, shots[i]));
      cv::Mat picture(truth[i].size(), CV_8UC3, cv::Scalar(150, 90, 70));
      picture.setTo(cv::Scalar(40, 60, 190), truth[i]);
      picture.setTo(cv::Scalar(225, 230, 235), render({object[1]}, shots[i]) & truth[i]);
      cv::Mat grain(picture.size(), CV_16SC3);
      random.fill(grain, cv::RNG::NORMAL, 0, 6);
      cv::add(picture, grain, picture, cv::noArray(), CV_8U);
      const auto file = s.folder() / ("shot" + std::to_string(i) + ".png");
      cv::imwrite(file.string(), picture);
      views.push_back({std::to_string(i), file, make_view("view", shots[i].matrix()).camera, {}});
    }
  }
};

double mask_overlap(const cv::Mat& a, const cv::Mat& b) {
  return 2.0 * cv::countNonZero(a & b) / (cv::countNonZero(a) + cv::countNonZero(b));
}

// The lowest part of a mask, of a share of its pixels.
cv::Mat lowest(const cv::Mat& mask, double share) {
  cv::Mat part = mask.clone();
  double left = (1 - share) * cv::countNonZero(mask);
  for (int y = 0; y < mask.rows && left > 0; ++y) {
    left -= cv::countNonZero(mask.row(y));
    part.row(y).setTo(cv::Scalar(0));
  }
  return part;
}

TEST_CASE(
    "What masks lost comes back, what one has too much goes, a view without a mask gets one, and right masks stay") {
  const Scratch s;
  const Studio studio(s);
  std::vector<cv::Mat> masks;
  for (const cv::Mat& mask : studio.truth) masks.push_back(mask.clone());
  const cv::Mat lost = lowest(masks[2], 0.15);
  masks[2].setTo(cv::Scalar(0), lost);
  cv::Mat shadow = cv::Mat::zeros(masks[7].size(), CV_8U);
  cv::ellipse(shadow, {330, 300}, {60, 25}, 0, 0, 360, cv::Scalar(255), cv::FILLED);
  shadow &= studio.truth[7] == 0;
  masks[7] |= shadow;
  masks[5] = cv::Scalar(0);
  const std::vector<MaskChange> changes = repair_masks(studio.views, PixelOrigin::kCenter, masks);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    INFO("view " << i << ": " << changes[i].added << " added, " << changes[i].removed << " removed");
    CHECK(mask_overlap(masks[i], studio.truth[i]) > (i == 5 ? 0.95 : 0.99));
    if (i != 2 && i != 7 && i != 5) CHECK(changes[i].share < 0.003);
  }
  CHECK(changes[2].added > 0.9 * cv::countNonZero(lost));
  CHECK(changes[7].removed > 0.7 * cv::countNonZero(shadow));
  const auto lines = change_lines(studio.views, changes);
  REQUIRE(lines.size() >= 2);
  CHECK_THAT(lines[0], Contains("mask of view 2: " + std::to_string(changes[2].added) + " pixels added"));
}

TEST_CASE("Masks of few views stay") {
  const Scratch s;
  const Studio studio(s);
  std::vector<PhotographedView> few(studio.views.begin(), studio.views.begin() + 3);
  std::vector<cv::Mat> cut{studio.truth[0], studio.truth[1], studio.truth[2] & ~lowest(studio.truth[2], 0.3)};
  const cv::Mat before = cut[2].clone();
  CHECK(repair_masks(few, PixelOrigin::kCenter, cut)[2].share == 0);
  CHECK(cv::countNonZero(before != cut[2]) == 0);
}

TEST_CASE("Repairs of masks on the way to a hull are told, and need cameras") {
  const Scratch s;
  const Studio studio(s);
  Scene scene;
  for (const PhotographedView& view : studio.views) {
    scene.views.push_back({view.name, view.camera, view.photograph.filename(), {}, {}, {}});
  }
  const std::string file = s.write("scene.json", write_scene_json(scene)).string();
  const std::string report = (s.folder() / "report.json").string();
  // Brighter than the wall is red only: the white part is object in "red" but lost in "saturation".
  const Outcome made = run(file + " --mask threshold:red --repair-masks --simplify 1 --report " + report);
  INFO(made.output);
  CHECK(made.code == 0);
  const auto json = nlohmann::json::parse(nef::read_file(report));
  REQUIRE(json["views"].size() == 10);
  for (const auto& view : json["views"]) CHECK(view["mask_added_px"].is_number_unsigned());
  const Outcome alone = run(file + " --repair-masks");
  CHECK(alone.code == 2);
  CHECK_THAT(alone.output, Contains("--mask"));
  const Outcome unknown = run(s.folder().string() + " --turntable 10 --refine --mask auto --repair-masks");
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.output, Contains("--refined-scene"));
}

}  // namespace
}  // namespace nef::visual_hull
