// SPDX-License-Identifier: Apache-2.0
//
// An object of two colours before a background of one of them: only a person can tell what belongs to it.
#include "apps/visual_hull/masks/strokes.h"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/masks/cut_out.h"
#include "nef/base/error.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using testing::Scratch;

/// A yellow and a blue disc that overlap, a yellow disc apart, before gray.
struct TwoDiscs {
  cv::Mat picture{150, 200, CV_8UC3, cv::Scalar(120, 120, 120)};
  cv::Mat blue = cv::Mat::zeros(150, 200, CV_8U);
  cv::Mat both;

  TwoDiscs() {
    cv::Mat yellow = cv::Mat::zeros(150, 200, CV_8U);
    cv::circle(yellow, {70, 75}, 28, cv::Scalar(255), cv::FILLED);
    cv::circle(blue, {105, 75}, 24, cv::Scalar(255), cv::FILLED);
    both = yellow | blue;
    picture.setTo(cv::Scalar(40, 200, 220), yellow);
    picture.setTo(cv::Scalar(200, 80, 30), blue);
    cv::circle(picture, {170, 30}, 14, cv::Scalar(40, 200, 220), cv::FILLED);
    cv::RNG random(3);
    cv::Mat grain(picture.size(), CV_16SC3);
    random.fill(grain, cv::RNG::NORMAL, 0, 4);
    cv::add(picture, grain, picture, cv::noArray(), CV_8U);
  }
};

constexpr int kThick = 5;
const cv::Scalar kGreen(0, 255, 0);
const cv::Scalar kRed(0, 0, 255);

double common_share(const cv::Mat& a, const cv::Mat& b) {
  return 2.0 * cv::countNonZero(a & b) / (cv::countNonZero(a) + cv::countNonZero(b));
}

TEST_CASE("Strokes choose what the object is") {
  const Scratch s;
  const TwoDiscs painted;
  const auto photograph = s.folder() / "photo.png";
  cv::imwrite(photograph.string(), painted.picture);
  const auto folder = s.folder() / "strokes";
  std::filesystem::create_directory(folder);
  const auto cut = [&](const cv::Mat& strokes) {
    cv::imwrite((folder / "photo.png").string(), strokes);
    const CutOuts made = cut_out({photograph}, parse_mask_method("grabcut:" + folder.string()));
    CHECK(made.chosen == "GrabCut, by strokes in 1 of 1 photographs");
    return made.masks[0];
  };
  cv::Mat both = painted.picture.clone();
  cv::line(both, {55, 75}, {118, 75}, kGreen, kThick);
  cv::line(both, {20, 20}, {20, 130}, kRed, kThick);
  cv::line(both, {160, 30}, {178, 30}, kRed, kThick);
  CHECK(common_share(cut(both), painted.both) > 0.98);
  cv::Mat one = painted.picture.clone();
  cv::line(one, {95, 75}, {118, 75}, kGreen, kThick);
  cv::line(one, {50, 75}, {66, 75}, kRed, kThick);
  cv::line(one, {20, 20}, {20, 130}, kRed, kThick);
  CHECK(common_share(cut(one), painted.blue) > 0.97);
}

TEST_CASE("Without red the margins are background, and likely pixels follow the nearest one") {
  cv::Mat strokes(100, 100, CV_8UC3, cv::Scalar(90, 90, 90));
  cv::line(strokes, {40, 50}, {60, 50}, kGreen, kThick);
  const cv::Mat seeds = seeds_from_strokes(strokes, "strokes");
  CHECK(seeds.at<std::uint8_t>(50, 50) == cv::GC_FGD);
  CHECK(seeds.at<std::uint8_t>(0, 0) == cv::GC_BGD);
  CHECK(seeds.at<std::uint8_t>(55, 50) == cv::GC_PR_FGD);
  CHECK(seeds.at<std::uint8_t>(10, 10) == cv::GC_PR_BGD);
}

TEST_CASE("Strokes that say nothing, of another size, or missing, are refused with what to do") {
  const Scratch s;
  const TwoDiscs painted;
  const auto photograph = s.folder() / "photo.png";
  cv::imwrite(photograph.string(), painted.picture);
  const auto cut = [&](const std::string& strokes) {
    return cut_out({photograph}, parse_mask_method("grabcut:" + strokes));
  };
  CHECK_THROWS_WITH(cut(photograph.string()), Catch::Contains("no stroke of #00FF00"));
  const auto small = (s.folder() / "small.png").string();
  cv::imwrite(small, cv::Mat(10, 10, CV_8UC3, kGreen));
  CHECK_THROWS_WITH(cut(small), Catch::Contains("has 10 x 10 pixels"));
  CHECK_THROWS_WITH(cut((s.folder() / "none").string()), Catch::Contains("there is no"));
  const auto empty = s.folder() / "empty";
  std::filesystem::create_directory(empty);
  CHECK(cut(empty.string()).chosen == "GrabCut, by strokes in 0 of 1 photographs");
}

}  // namespace
}  // namespace nef::visual_hull
