// SPDX-License-Identifier: Apache-2.0
//
// Borders of a board in photographs of which everything is known, and cameras by them.
#include "apps/visual_hull/calibrate/border_fit.h"

#include <catch2/catch.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/calibrate/opencv_camera.h"
#include "tests/visual_hull/calibrate/rendered_board.h"

namespace nef::visual_hull {
namespace {

using testing::BoardCamera;
using testing::BoardStudio;
using testing::Egg;
using testing::turntable_before;
using testing::usual_lens;

cv::Mat gray_photograph(const BoardStudio& studio, const BoardCamera& camera, std::uint64_t seed) {
  cv::Mat gray;
  cv::cvtColor(studio.photograph(camera, seed).picture, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

// A camera that is off by a third of a degree and half a millimetre.
Pose slightly_moved(const Pose& pose) {
  Pose result = pose;
  result.rotation = Eigen::AngleAxisd(0.006, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix() * pose.rotation;
  result.translation = pose.translation + Eigen::Vector3d(-0.4, 0.2, 0.3);
  return result;
}

double degrees_apart(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.rotation * b.rotation.transpose()).angle() * 180 / M_PI;
}

TEST_CASE("Borders of a board are the sides of its tiles where black meets white") {
  const Board board = parse_board("charuco:4x3,30mm,22mm,DICT_5X5");
  const std::vector<BoardBorder> borders = board_borders(board);
  const std::vector<BlackTile> tiles = black_tiles(board);
  const auto black = [&](const Eigen::Vector2d& p) {
    const double x = p.x() + board.width() / 2;
    const double y = board.height() / 2 - p.y();
    return std::any_of(tiles.begin(), tiles.end(), [&](const BlackTile& t) {
      return x > t.x && x < t.x + t.width && y > t.y && y < t.y + t.height;
    });
  };
  CHECK(borders.size() > 500);
  for (const BoardBorder& b : borders) {
    REQUIRE(black(b.at - 0.1 * b.to_white));
    REQUIRE_FALSE(black(b.at + 0.1 * b.to_white));
    // What is said of the distances to the next borders holds, to the quarter of a millimetre that they are known to.
    if (b.black > 1) REQUIRE(black(b.at - (b.black - 0.6) * b.to_white));
    if (b.white > 1) REQUIRE_FALSE(black(b.at + (b.white - 0.6) * b.to_white));
  }
}

TEST_CASE("Borders are found in a photograph to a tenth of a pixel, and not where the object covers them") {
  const Board board = parse_board(kUsualBoard);
  const Lens lens = usual_lens();
  const BoardCamera camera = turntable_before(lens, 5)[1];
  const std::vector<BoardBorder> borders = board_borders(board);
  const std::vector<SeenBorder> open =
      find_borders(gray_photograph(BoardStudio(board), camera, 1), borders, lens, slightly_moved(camera.pose));
  REQUIRE(open.size() > 1000);
  std::vector<cv::Point3d> places;
  for (const SeenBorder& b : open) places.push_back(b.at);
  const std::vector<cv::Point2d> truth = seen_points(places, lens, OpenCvPose::of(camera.pose));
  double squares = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const cv::Point2d off = open[i].point - truth[i];
    const double across = off.x * open[i].direction[0] + off.y * open[i].direction[1];
    CHECK(std::abs(across) < 0.6);
    squares += across * across;
  }
  CHECK(std::sqrt(squares / static_cast<double>(open.size())) < 0.12);
  const std::vector<SeenBorder> covered =
      find_borders(gray_photograph(BoardStudio(board, Egg()), camera, 1), borders, lens, slightly_moved(camera.pose));
  CHECK(covered.size() < open.size() - 100);
  CHECK(covered.size() > 500);
}

// Seen by a camera whose brightness is a power of light, black spreads over white, or white over black.
cv::Mat with_curve(const cv::Mat& gray, double power) {
  cv::Mat table(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i)
    table.at<std::uint8_t>(i) = cv::saturate_cast<std::uint8_t>(255 * std::pow(i / 255.0, power));
  cv::Mat result;
  cv::LUT(gray, table, result);
  return result;
}

TEST_CASE("Cameras by borders do not depend on how far black spreads") {
  const Board board = parse_board(kUsualBoard);
  const Lens lens = usual_lens();
  const std::vector<BoardCamera> cameras = turntable_before(lens, 4);
  const std::vector<BoardBorder> borders = board_borders(board);
  const BoardStudio studio(board, Egg());
  for (const double power : {1.0, 1 / 2.2, 2.2}) {
    std::vector<BorderView> views;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const cv::Mat gray = with_curve(gray_photograph(studio, cameras[i], i), power);
      views.push_back(
          {find_borders(gray, borders, lens, slightly_moved(cameras[i].pose)), slightly_moved(cameras[i].pose)});
    }
    BoardLens fitted;
    fitted.lens = lens;
    fit_borders(fitted, views, false);
    CHECK(fitted.lens.fx == lens.fx);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      INFO("power " << power << " view " << i);
      CHECK(views[i].kept > 500);
      CHECK(degrees_apart(views[i].pose, cameras[i].pose) < (power == 1 ? 0.03 : 0.06));
      const Eigen::Vector3d centre = -views[i].pose.rotation.transpose() * views[i].pose.translation;
      CHECK((centre - cameras[i].centre()).norm() < 0.3);
      CHECK(views[i].off_px < 0.1);
    }
  }
}

}  // namespace
}  // namespace nef::visual_hull
