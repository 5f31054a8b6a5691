// SPDX-License-Identifier: Apache-2.0
//
// Calibration by rendered photographs: the lens and the poses that made them are known.
#include "apps/visual_hull/calibrate/calibrate.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/formats/write_scene.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/visual_hull/calibrate/rendered_board.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;
using testing::BoardCamera;
using testing::BoardStudio;
using testing::Egg;
using testing::looking;
using testing::Outcome;
using testing::Photographed;
using testing::run;
using testing::Scratch;
using testing::turntable_before;
using testing::usual_lens;

fs::path photograph(const Scratch& s, const std::string& name, const BoardStudio& studio, const BoardCamera& camera) {
  fs::path file = s.folder() / name;
  REQUIRE(cv::imwrite(file.string(), studio.photograph(camera, std::hash<std::string>()(name)).picture));
  return file;
}

std::vector<fs::path> photographs(const Scratch& s, const std::string& name, const BoardStudio& studio,
                                  const std::vector<BoardCamera>& cameras) {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    files.push_back(photograph(s, name + std::to_string(i) + ".png", studio, cameras[i]));
  }
  return files;
}

// A board held at several tilts.
std::vector<BoardCamera> held_at_tilts(const Lens& lens) {
  std::vector<BoardCamera> cameras;
  for (int i = 0; i < 9; ++i) {
    const double a = 0.8 * i;
    const double e = (i % 2 == 0 ? 40 : 60) * M_PI / 180;
    const Eigen::Vector3d from =
        300 * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    cameras.push_back({lens, looking(from, {30 * std::cos(2.0 * i), 20 * std::sin(3.0 * i), 0}, 0.7 * i)});
  }
  return cameras;
}

double degrees_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle() * 180 / M_PI;
}

// Cameras to a tenth of a degree, and in their places to a share of their distance, which that of the focal length
// limits.
void check_cameras(const Calibration& found, const std::vector<BoardCamera>& truth, double share) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    INFO("view " << i);
    const CalibratedView& view = found.views[i];
    CHECK(view.refused.empty());
    CHECK(view.error_px < 0.3);
    CHECK(view.borders > 500);
    CHECK(degrees_between(view.pose.rotation, truth[i].pose.rotation) < 0.1);
    const Eigen::Vector3d centre = -view.pose.rotation.transpose() * view.pose.translation;
    CHECK((centre - truth[i].centre()).norm() < share * truth[i].centre().norm());
  }
}

TEST_CASE("Cameras of a turntable come within .1 degrees of the truth, by the board that turns with the object") {
  const Scratch s;
  const BoardStudio studio(parse_board(kUsualBoard), Egg());
  const std::vector<BoardCamera> truth = turntable_before(usual_lens(), 6);
  const Calibration found = calibrate(photographs(s, "view", studio, truth), parse_board(kUsualBoard));
  check_cameras(found, truth, 0.015);
  CHECK(found.error_px < 0.3);
  CHECK(found.lens.lens.fx == Approx(760).epsilon(0.015));
  CHECK(found.lens.lens.distortion[0] == Approx(-0.12).margin(0.08));
  // Whichever way it turns, a board of one tilt does not show where the axis of the lens is.
  CHECK(found.lens.centred);
  REQUIRE(found.notes.size() == 1);
  CHECK_THAT(found.notes[0], Contains("its middle is assumed") && Contains("--lens"));
  const Scene scene = found.scene();
  REQUIRE(scene.views.size() == 6);
  // What the scene says of its cameras is what they are off by, in the image of a point above the board.
  REQUIRE(scene.camera_error);
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector3d point(20, -15, 40);
    const auto seen = [&](const Pose& pose) -> Eigen::Vector2d {
      return 760 * (pose.rotation * point + pose.translation).hnormalized();
    };
    squares += (seen(found.views[i].pose) - seen(truth[i].pose)).squaredNorm() / 6;
  }
  CHECK(std::sqrt(squares) < 3 * *scene.camera_error);
  CHECK(*scene.camera_error < 3 * std::sqrt(squares));
  const std::filesystem::path file = s.folder() / "scene.json";
  write_scene_file(file, scene);
  CHECK(read_scene(file).camera_error == Approx(*scene.camera_error));
  CHECK(scene.views[3].name == "view3.png");
  CHECK(scene.views[3].distortion.coefficients == found.lens.lens.distortion);
}

TEST_CASE("A lens whose axis is not in the middle is determined by a series of its own") {
  const Scratch s;
  const Board board = parse_board(kUsualBoard);
  const BoardStudio studio(board);
  const Lens lens = usual_lens(760, 14, -9);
  const std::vector<BoardCamera> truth = turntable_before(lens, 3);
  const Calibration found =
      calibrate(photographs(s, "view", studio, truth), board, photographs(s, "lens", studio, held_at_tilts(lens)));
  check_cameras(found, truth, 0.005);
  CHECK_FALSE(found.lens.centred);
  CHECK(found.lens.lens.cx == Approx(lens.cx).margin(1.5));
  CHECK(found.lens.lens.cy == Approx(lens.cy).margin(1.5));
  CHECK(found.lens.lens.fx == Approx(760).epsilon(0.003));
  CHECK(found.notes.empty());
}

TEST_CASE("A lens of another zoom is noticed, and the photographs do not bend it") {
  const Scratch s;
  const Board board = parse_board(kUsualBoard);
  const BoardStudio studio(board);
  const std::vector<BoardCamera> zoomed = turntable_before(usual_lens(900), 3);
  const Calibration found = calibrate(photographs(s, "view", studio, zoomed), board,
                                      photographs(s, "lens", studio, held_at_tilts(usual_lens(760, 14, -9))));
  CHECK(found.lens.lens.fx == Approx(760).epsilon(0.003));
  REQUIRE(found.notes.size() == 1);
  CHECK_THAT(found.notes[0], Contains("were zoom and focus the same?"));
}

TEST_CASE("Photographs that are of no use are left out with the reason, and the others stay right") {
  const Scratch s;
  const Board board = parse_board(kUsualBoard);
  const BoardStudio studio(board);
  const std::vector<BoardCamera> truth = turntable_before(usual_lens(), 6);
  std::vector<fs::path> files = photographs(s, "view", studio, truth);
  const fs::path wall = s.folder() / "wall.png";
  cv::imwrite(wall.string(), cv::Mat(480, 640, CV_8UC3, cv::Scalar(120, 130, 140)));
  files.push_back(wall);
  files.push_back(photograph(s, "torn.png", BoardStudio(board, {}, 10), truth[2]));
  const fs::path small = s.folder() / "small.png";
  cv::imwrite(small.string(), cv::Mat(300, 400, CV_8UC3, cv::Scalar(120, 130, 140)));
  files.push_back(small);
  const Calibration found = calibrate(files, board);
  check_cameras(found, truth, 0.015);
  CHECK_THAT(found.views[6].refused, Contains("no two markers"));
  CHECK_THAT(found.views[7].refused, Contains("its corners are off by"));
  CHECK_THAT(found.views[8].refused, Contains("400 x 300 pixels, the first photograph 640 x 480"));
  CHECK(found.scene().views.size() == 6);
  REQUIRE(found.notes.size() == 4);
  CHECK_THAT(found.notes[1], Contains("torn.png is left out"));
  CHECK_THROWS_WITH(calibrate({files[0], files[1], wall}, board),
                    Contains("in 2 of 3 photographs") && Contains("wall.png"));
  CHECK_THROWS_AS(calibrate({s.write("text.png", "no image")}, board), nef::InputError);
}

TEST_CASE("From photographs with a board to a hull of the right size in millimetres") {
  const Scratch s;
  const fs::path folder = s.folder() / "photographs";
  fs::create_directories(folder);
  const BoardStudio studio(parse_board(kUsualBoard), Egg());
  const std::vector<BoardCamera> truth = turntable_before(usual_lens(), 6);
  std::vector<Photographed> shots;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    shots.push_back(studio.photograph(truth[i], i));
    cv::imwrite((folder / ("p" + std::to_string(i) + ".png")).string(), shots.back().picture);
  }
  const std::string scene = (s.folder() / "scene.json").string();
  const std::string report = (s.folder() / "report.json").string();
  const Outcome found = run("calibrate " + folder.string() + " -o " + scene + " --report " + report);
  CHECK(found.code == 0);
  CHECK_THAT(found.output, Contains("p5.png: ") && Contains("focal length 7") && Contains("6 views"));
  const auto json = nlohmann::json::parse(nef::read_file(report));
  CHECK(json["views"].size() == 6);
  CHECK(json["error_px"] < 0.3);
  CHECK(json["lens"]["principal_point_assumed"] == true);
  // The scene names the photographs; the hull is that of perfect masks and cameras, up to a percent.
  CHECK(read_scene(scene).views[2].image == "photographs/p2.png");
  const auto volume_of = [&](const std::string& words) {
    const Outcome made = run(words + " --simplify 0.5 --report " + report);
    CHECK(made.code == 0);
    return nlohmann::json::parse(nef::read_file(report))["result"]["volume_double"].get<double>();
  };
  const double made = volume_of(scene + " --mask auto");
  Scene perfect;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::string name = "mask" + std::to_string(i) + ".png";
    cv::imwrite((s.folder() / name).string(), shots[i].mask);
    perfect.views.push_back(make_view(name, truth[i].lens, truth[i].pose));
    perfect.views.back().image = name;
  }
  const double right = volume_of(s.write("perfect.json", write_scene_json(perfect)).string());
  CHECK(made == Approx(right).epsilon(0.01));
}

TEST_CASE("visual_hull calibrate says what it needs") {
  const Scratch s;
  const std::string wall = (s.folder() / "wall.png").string();
  cv::imwrite(wall, cv::Mat(300, 400, CV_8UC3, cv::Scalar(120, 130, 140)));
  const Outcome none = run("calibrate " + wall + " -o " + s.folder().string() + "/scene.json");
  CHECK(none.code == 2);
  CHECK_THAT(none.output, Contains("in 0 of 1 photographs, 3 are needed") && Contains("--board"));
  CHECK(run("calibrate " + wall + " --board charuco:7x5 -o x.json").code == 2);
  CHECK(run("calibrate " + s.folder().string() + "/missing.png -o x.json").code == 2);
}

}  // namespace
}  // namespace nef::visual_hull
