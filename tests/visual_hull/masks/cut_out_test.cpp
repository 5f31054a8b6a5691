// SPDX-License-Identifier: Apache-2.0
//
// Masks of painted photographs, whose objects are known.
#include "apps/visual_hull/masks/cut_out.h"

#include <catch2/catch.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/silhouette/channel.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Outcome;
using testing::run;
using testing::Scratch;

constexpr int kPhotoWidth = 200;
constexpr int kPhotoHeight = 150;

/// Photographs with the masks that they should get.
struct PaintedSeries {
  std::vector<std::filesystem::path> files;
  std::vector<cv::Mat> truth;
};

// Twice the common pixels over those of both.
double overlap(const cv::Mat& a, const cv::Mat& b) {
  return 2.0 * cv::countNonZero(a & b) / (cv::countNonZero(a) + cv::countNonZero(b));
}

double least_overlap(const PaintedSeries& painted, const CutOuts& cut) {
  double least = 1;
  for (std::size_t i = 0; i < painted.truth.size(); ++i) {
    least = std::min(least, overlap(painted.truth[i], cut.masks[i]));
  }
  return least;
}

// An ellipse that turns and moves a little from picture to picture.
cv::Mat shape(int i) {
  cv::Mat mask = cv::Mat::zeros(kPhotoHeight, kPhotoWidth, CV_8U);
  cv::ellipse(mask, {90 + 3 * i, 75}, {40, 22}, 20.0 * i, 0, 360, cv::Scalar(255), cv::FILLED);
  return mask;
}

PaintedSeries paint(const Scratch& s, const cv::Mat& background,
                    const std::function<void(cv::Mat&, const cv::Mat&)>& object, double noise = 5) {
  PaintedSeries painted;
  cv::RNG random(7);
  for (int i = 0; i < 5; ++i) {
    painted.truth.push_back(shape(i));
    cv::Mat picture = background.clone();
    object(picture, painted.truth.back());
    cv::Mat grain(picture.size(), CV_16SC3);
    random.fill(grain, cv::RNG::NORMAL, 0, noise);
    cv::add(picture, grain, picture, cv::noArray(), CV_8U);
    painted.files.push_back(s.folder() / ("photo" + std::to_string(i) + ".png"));
    cv::imwrite(painted.files.back().string(), picture);
  }
  return painted;
}

cv::Mat plain(const cv::Scalar& color) { return {kPhotoHeight, kPhotoWidth, CV_8UC3, color}; }

// A dark wall above a blue table: no brightness separates an object from both.
cv::Mat wall_and_table() {
  cv::Mat background = plain({90, 70, 55});
  background.rowRange(60, kPhotoHeight).setTo(cv::Scalar(190, 110, 100));
  return background;
}

void set_color(cv::Mat& picture, const cv::Mat& mask, const cv::Scalar& color) { picture.setTo(color, mask); }

TEST_CASE("Masks are cut by what separates object and background best") {
  const Scratch s;
  SECTION("by colour, where brightness does not") {
    const PaintedSeries painted = paint(s, wall_and_table(), [](cv::Mat& picture, const cv::Mat& mask) {
      set_color(picture, mask, {70, 100, 150});
      picture(cv::Rect(95, 70, 4, 4)).setTo(cv::Scalar(235, 235, 235), mask(cv::Rect(95, 70, 4, 4)));
    });
    const CutOuts cut = cut_out(painted.files, {}, nef::Monitor().on_threads(2));
    INFO(cut.chosen);
    CHECK_THAT(cut.chosen, Contains("red"));
    CHECK(least_overlap(painted, cut) >= 0.99);
    CHECK(cut.notes.empty());
    CHECK(*std::min_element(cut.quality.begin(), cut.quality.end()) > 5);
  }
  SECTION("and not the lamp in the corner, although it is larger") {
    cv::Mat background = plain({25, 28, 24});
    background(cv::Rect(0, 0, kPhotoWidth, 22)).setTo(cv::Scalar(240, 240, 240));
    const PaintedSeries painted = paint(s, background, [](cv::Mat& picture, const cv::Mat& mask) {
      set_color(picture, mask, {200, 205, 210});
    });
    const CutOuts cut = cut_out(painted.files, {});
    INFO(cut.chosen);
    CHECK(least_overlap(painted, cut) >= 0.99);
  }
  SECTION("a dark object before a bright wall") {
    const PaintedSeries painted = paint(s, plain({220, 220, 220}), [](cv::Mat& picture, const cv::Mat& mask) {
      set_color(picture, mask, {60, 60, 60});
    });
    const CutOuts cut = cut_out(painted.files, parse_mask_method("threshold"));
    CHECK_THAT(cut.chosen, Contains("darkness of gray"));
    CHECK(least_overlap(painted, cut) >= 0.99);
    const CutOuts typed = cut_out(painted.files, parse_mask_method("threshold:value:<140"));
    CHECK(least_overlap(painted, typed) >= 0.99);
  }
}

TEST_CASE("Masks from a background, a screen and a rectangle") {
  const Scratch s;
  // A shadow, of the background's colour and darker, is none of the object.
  const auto with_shadow = [](cv::Mat& picture, const cv::Mat& mask) {
    cv::Mat shadow;
    cv::dilate(mask, shadow, cv::Mat::ones(25, 25, CV_8U));
    cv::Mat dark = picture * 0.6;
    dark.copyTo(picture, shadow);
    set_color(picture, mask, {60, 190, 200});
  };
  SECTION("a picture without the object") {
    const PaintedSeries painted = paint(s, wall_and_table(), with_shadow);
    const std::string empty = (s.folder() / "empty.png").string();
    cv::imwrite(empty, wall_and_table());
    CHECK(least_overlap(painted, cut_out(painted.files, parse_mask_method("background:" + empty),
                                         nef::Monitor().on_threads(2))) >= 0.99);
  }
  SECTION("a green screen") {
    const PaintedSeries painted = paint(s, plain({70, 180, 60}), with_shadow);
    CHECK(least_overlap(
              painted, cut_out(painted.files, parse_mask_method("key:#3cb446"), nef::Monitor().on_threads(2))) >= 0.99);
  }
  SECTION("the median of pictures in which the object moves") {
    PaintedSeries painted;
    for (int i = 0; i < 5; ++i) {
      painted.truth.push_back(cv::Mat::zeros(kPhotoHeight, kPhotoWidth, CV_8U));
      painted.truth.back()(cv::Rect(10 + 36 * i, 40, 30, 60)).setTo(cv::Scalar(255));
      cv::Mat picture = wall_and_table();
      set_color(picture, painted.truth.back(), {60, 190, 200});
      painted.files.push_back(s.folder() / (std::to_string(i) + ".png"));
      cv::imwrite(painted.files.back().string(), picture);
    }
    CHECK(least_overlap(painted, cut_out(painted.files, parse_mask_method("background:median"),
                                         nef::Monitor().on_threads(2))) == 1);
    painted.files.resize(2);
    CHECK_THROWS_AS(cut_out(painted.files, parse_mask_method("background:median")), nef::InputError);
  }
  SECTION("GrabCut") {
    const PaintedSeries painted = paint(s, wall_and_table(), [](cv::Mat& picture, const cv::Mat& mask) {
      set_color(picture, mask, {70, 100, 150});
    });
    const CutOuts cut =
        cut_out(painted.files, parse_mask_method("grabcut:30,20,150,120"), nef::Monitor().on_threads(2));
    CHECK(least_overlap(painted, cut) >= 0.99);
    const CutOuts again = cut_out(painted.files, parse_mask_method("grabcut:30,20,150,120"));
    for (std::size_t i = 0; i < cut.masks.size(); ++i) CHECK(cv::countNonZero(cut.masks[i] != again.masks[i]) == 0);
  }
}

TEST_CASE("Masks to be looked at are named") {
  const Scratch s;
  PaintedSeries painted = paint(s, plain({25, 28, 24}), [](cv::Mat& picture, const cv::Mat& mask) {
    set_color(picture, mask, {200, 205, 210});
  });
  cv::imwrite(painted.files[3].string(), plain({25, 28, 24}));  // somebody has taken it away
  cv::Mat small = plain({25, 28, 24});
  small(cv::Rect(80, 70, 12, 12)).setTo(cv::Scalar(200, 205, 210));
  cv::imwrite(painted.files[4].string(), small);
  const CutOuts cut = cut_out(painted.files, {}, nef::Monitor().on_threads(2));
  REQUIRE(cut.notes.size() == 2);
  CHECK_THAT(cut.notes[0], Contains("photo3.png: no object was found"));
  CHECK_THAT(cut.notes[1], Contains("photo4.png: the object has 144 pixels"));
  CHECK_THROWS_AS(cut_out({s.folder() / "none.png"}, {}), nef::InputError);
  CHECK_THROWS_AS(cut_out({}, {}), nef::InputError);
}

TEST_CASE("Methods of masks are parsed or refused") {
  CHECK(parse_mask_method("threshold:red-blue:100").channel == ThresholdOptions::Channel::kRedBlue);
  CHECK(parse_mask_method("threshold:red-blue:<1/2").below);
  CHECK(parse_mask_method("key:#0a0B0c").key == std::array<int, 3>{10, 11, 12});
  for (const char* bad :
       {"", "automatic", "auto:1", "threshold:infrared", "threshold:gray:", "threshold:gray:x", "background",
        "background:", "key", "key:#12345", "key:#12345g", "grabcut:1,2,3", "grabcut:1,2,3,0", "grabcut:1,2,3,4.5"}) {
    INFO(bad);
    CHECK_THROWS_AS(parse_mask_method(bad), nef::InputError);
  }
}

TEST_CASE("Channels are what their names say") {
  using Channel = ThresholdOptions::Channel;
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(40, 200, 100));  // blue, green, red
  const auto value = [&pixel](Channel channel) { return int{pick_channel(pixel, channel).at<unsigned char>(0, 0)}; };
  CHECK(value(Channel::kValue) == 200);
  CHECK(value(Channel::kSaturation) == 204);  // 255 * 160 / 200
  CHECK(std::abs(value(Channel::kRedBlue) - (127 + 30)) <= 1);
  CHECK(std::abs(value(Channel::kRedGreen) - (127 - 50)) <= 1);
  CHECK(std::abs(value(Channel::kGreenBlue) - (127 + 80)) <= 1);
  for (const std::string& name : channel_names()) CHECK(channel_names()[std::size_t(parse_channel(name))] == name);
}

TEST_CASE("The command writes masks and a picture of all") {
  const Scratch s;
  const PaintedSeries painted = paint(s, wall_and_table(), [](cv::Mat& picture, const cv::Mat& mask) {
    set_color(picture, mask, {70, 100, 150});
  });
  const std::string photographs = s.folder().string();
  const std::string masks = (s.folder() / "masks").string();
  const Outcome outcome = run("masks " + photographs + " -o " + masks + "/ --json");
  INFO(outcome.output);
  REQUIRE(outcome.code == 0);
  const nlohmann::json report = nlohmann::json::parse(outcome.output);
  CHECK(report["command"] == "masks");
  CHECK(report["masks"].size() == 5);
  for (std::size_t i = 0; i < painted.files.size(); ++i) {
    const cv::Mat mask =
        cv::imread((s.folder() / "masks" / painted.files[i].filename()).string(), cv::IMREAD_GRAYSCALE);
    CHECK(overlap(painted.truth[i], mask) >= 0.99);
    CHECK(report["masks"][i]["share"].get<double>() ==
          Approx(static_cast<double>(cv::countNonZero(mask)) / (kPhotoWidth * kPhotoHeight)));
  }
  CHECK(cv::imread(masks + "/overview/masks.png").cols == 5 * kPhotoWidth);
  const Outcome over = run("masks " + photographs + " -o " + photographs);
  CHECK(over.code == 2);
  CHECK_THAT(over.output, Contains("would replace the photograph"));
  CHECK(run("masks " + photographs + " -o " + masks + " --mask key:mauve").code == 2);
  const Outcome missing = run("masks " + photographs + "/nothing.png -o " + masks);
  CHECK(missing.code == 2);
  CHECK_THAT(missing.output, Contains("no such file; check the path"));
  const Outcome text = run("masks " + s.write("notes.png", "no picture").string() + " -o " + masks);
  CHECK(text.code == 2);
  CHECK_THAT(text.output, Contains("cannot be read as an image"));
}

TEST_CASE("A hull from photographs is that from their masks") {
  const Scratch s;
  const PaintedSeries painted = paint(s, wall_and_table(), [](cv::Mat& picture, const cv::Mat& mask) {
    set_color(picture, mask, {70, 100, 150});
  });
  const std::string turntable = " --turntable 5 --K 300,100,75 --radius 10 --height 1 --json ";
  const std::string masks = (s.folder() / "masks").string();
  REQUIRE(run("masks " + s.folder().string() + " -o " + masks).code == 0);
  const Outcome direct = run(s.folder().string() + turntable + "--mask auto --images " + s.folder().string() + " -q");
  const Outcome two_steps = run(masks + turntable + "-q");
  INFO(direct.output << two_steps.output);
  REQUIRE(direct.code == two_steps.code);
  if (direct.code == 0) {
    CHECK(nlohmann::json::parse(direct.output)["result"]["volume_double"] ==
          nlohmann::json::parse(two_steps.output)["result"]["volume_double"]);
  }
  CHECK(run(s.folder().string() + turntable + "--mask auto --threshold 3").code == 2);
}

}  // namespace
}  // namespace nef::visual_hull
