// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/silhouette.h"

#include <catch2/catch.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using testing::axis_camera;
using testing::Scratch;

ThresholdOptions threshold(ThresholdOptions::Kind kind, double value = 0, bool invert = false) {
  return {kind, value, invert};
}

TEST_CASE("Masks, photographs and alpha channels") {
  using Kind = ThresholdOptions::Kind;
  cv::Mat gray(1, 4, CV_8U);
  for (int x = 0; x < 4; ++x) gray.at<std::uint8_t>(0, x) = static_cast<std::uint8_t>(x * 80);  // 0 80 160 240
  CHECK(cv::countNonZero(make_mask(gray, {})) == 2);
  CHECK(cv::countNonZero(make_mask(gray, threshold(Kind::kValue, 79))) == 3);
  CHECK(cv::countNonZero(make_mask(gray, threshold(Kind::kValue, 80))) == 2);
  CHECK(cv::countNonZero(make_mask(gray, threshold(Kind::kValue, 80, true))) == 2);
  CHECK(cv::countNonZero(make_mask(gray, threshold(Kind::kDefault, 0, true))) == 2);

  cv::Mat deep(1, 2, CV_16U);
  deep.at<std::uint16_t>(0, 0) = 40000;
  deep.at<std::uint16_t>(0, 1) = 255;
  CHECK(cv::countNonZero(make_mask(deep, {})) == 1);

  cv::Mat photo(10, 10, CV_8UC3, cv::Scalar(30, 30, 30));
  photo(cv::Rect(2, 2, 3, 3)).setTo(cv::Scalar(70, 90, 80));
  CHECK(cv::countNonZero(make_mask(photo, threshold(Kind::kOtsu))) == 9);
  CHECK(cv::countNonZero(make_mask(photo, threshold(Kind::kOtsu, 0, true))) == 91);

  cv::Mat cut_out(4, 4, CV_8UC4, cv::Scalar(0, 0, 0, 0));  // black on transparent
  cut_out(cv::Rect(1, 1, 2, 2)).setTo(cv::Scalar(0, 0, 0, 255));
  CHECK(cv::countNonZero(make_mask(cut_out, {})) == 4);
  const cv::Mat opaque(4, 4, CV_8UC4, cv::Scalar(255, 255, 255, 255));  // alpha says nothing: brightness does
  CHECK(cv::countNonZero(make_mask(opaque, {})) == 16);
}

TEST_CASE("A channel separates what brightness does not") {
  using Kind = ThresholdOptions::Kind;
  cv::Mat photo(8, 8, CV_8UC3, cv::Scalar(200, 60, 30));  // a blue screen
  photo(cv::Rect(2, 2, 3, 3)).setTo(cv::Scalar(30, 60, 130));
  ThresholdOptions options = threshold(Kind::kValue, 80);
  options.channel = ThresholdOptions::Channel::kRed;
  CHECK(cv::countNonZero(make_mask(photo, options)) == 9);
  options.channel = ThresholdOptions::Channel::kBlue;
  CHECK(cv::countNonZero(make_mask(photo, options)) == 64 - 9);
  options.kind = Kind::kOtsu;
  options.invert = true;
  CHECK(cv::countNonZero(make_mask(photo, options)) == 9);
  options.channel = ThresholdOptions::Channel::kAlpha;
  CHECK_THROWS_AS(make_mask(photo, options), nef::InputError);
}

TEST_CASE("Specks go by their area, an outer silhouette keeps its islands") {
  cv::Mat mask(40, 40, CV_8U, cv::Scalar(0));
  mask(cv::Rect(5, 5, 20, 20)).setTo(255);
  mask(cv::Rect(8, 8, 2, 2)).setTo(0);      // a hole of 4
  mask(cv::Rect(12, 12, 6, 6)).setTo(0);    // a hole of 36 ...
  mask(cv::Rect(14, 14, 1, 1)).setTo(255);  // ... with an island of 1
  mask(cv::Rect(30, 30, 3, 1)).setTo(255);  // an island of 3
  SilhouetteOptions options;
  CHECK(silhouette_of_mask(mask, {}, "v", options).contours == 5);
  options.min_area = 5;
  const ViewSilhouette clean = silhouette_of_mask(mask, {}, "v", options);
  CHECK(clean.contours == 2);
  CHECK(clean.holes == 1);
  options.simplify.outer = true;
  const ViewSilhouette outer = silhouette_of_mask(mask, {}, "v", options);
  CHECK(outer.contours == 4);
  CHECK(outer.holes == 1);
  options.min_area = 40;  // the large hole goes with the island in it
  CHECK(silhouette_of_mask(mask, {}, "v", options).contours == 2);
}

TEST_CASE("Images that cannot be used name their view") {
  const Scratch scratch;

  const auto broken = scratch.write("broken.png", "this is no image");
  CHECK_THROWS_WITH(read_mask(broken, "seventh", {}), Catch::Contains("view seventh: cannot read the image"));
  const std::string black = (scratch.folder() / "black.png").string();
  cv::imwrite(black, cv::Mat(3, 3, CV_8U, cv::Scalar(1)));
  CHECK_THROWS_WITH(read_mask(black, "seventh", {}),
                    Catch::Contains("view seventh: the silhouette is empty") && Catch::Contains("from 1 to 1"));
}

// A disc-free scene: the object fills the lower half of a 20 x 20 image and is cut by three sides of the frame.
cv::Mat half_mask() {
  cv::Mat mask(20, 20, CV_8U, cv::Scalar(0));
  mask(cv::Rect(0, 10, 20, 10)).setTo(255);
  return mask;
}

TEST_CASE("A silhouette that the frame cuts ends there, or leaves what is beyond uncarved") {
  SilhouetteOptions options;
  options.origin = PixelOrigin::kCorner;
  const ViewSilhouette outside = silhouette_of_mask(half_mask(), {}, "v", options);
  CHECK(outside.cut_by_frame);
  CHECK_FALSE(outside.background);
  CHECK(twice_area(outside.region.rings[0]) == 400);
  options.border = Border::kUnknown;
  const ViewSilhouette unknown = silhouette_of_mask(half_mask(), {}, "v", options);
  CHECK(unknown.background);
  REQUIRE(unknown.region.rings.size() == 1);
  CHECK(twice_area(unknown.region.rings[0]) == 400);  // the background: the upper half
  CHECK(locate(unknown.region, Point2(10, 5)) == Side::kInside);
  CHECK(locate(unknown.region, Point2(10, 15)) == Side::kOutside);
  // A silhouette that the frame does not cut is the same either way.
  cv::Mat whole(20, 20, CV_8U, cv::Scalar(0));
  whole(cv::Rect(5, 5, 4, 4)).setTo(255);
  CHECK_FALSE(silhouette_of_mask(whole, {}, "v", options).background);

  // In space: depth 10, (u, v) = 10 (x, y) / depth + 10.
  Matrix34 matrix{{{10, 0, 10, 0}, {0, 10, 10, 0}, {0, 0, 1, 0}}};
  const Scratch scratch;
  const std::string file = (scratch.folder() / "half.png").string();
  cv::imwrite(file, half_mask());
  Scene scene;
  scene.views.resize(1);
  scene.views[0].name = "v";
  scene.views[0].camera = Camera("v", matrix);
  scene.views[0].image = "half.png";
  scene.box = WorldBox{{-30, -30, -5}, {30, 30, 10}};
  Options run;
  run.silhouette = options;
  run.verify = true;
  const Result kept = compute(scene, scratch.folder(), run);
  CHECK(nef::contains(kept.hull, {0, 5, 10}));
  CHECK_FALSE(nef::contains(kept.hull, {0, -5, 10}));
  CHECK(nef::contains(kept.hull, {0, -20, 10}));  // beyond the frame
  CHECK(nef::contains(kept.hull, {0, 0, -5}));    // behind the camera
  REQUIRE(kept.views[0].verification.has_value());
  CHECK(kept.views[0].verification->inside);
  // The seen background has half of the frame's pyramid: 20 x 20 x 10 / 3 / 2.
  CHECK(nef::volume(kept.hull).value() == Rational(60 * 60 * 15) - Rational(2000, 3));
  run.silhouette.border = Border::kOutside;
  CHECK(nef::volume(compute(scene, scratch.folder(), run).hull).value() == Rational(2000, 3));
}

}  // namespace
}  // namespace nef::visual_hull
