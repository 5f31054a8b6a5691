// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/calibrate/board_lens.h"

#include <catch2/catch.hpp>

#include "tests/visual_hull/calibrate/rendered_board.h"

namespace nef::visual_hull {
namespace {

// The corners of the usual board as a camera sees them, off by a twentieth of a pixel or so.
SeenBoard seen_by(const testing::BoardCamera& camera, cv::RNG& random) {
  SeenBoard seen;
  const std::vector<Eigen::Vector3d> corners = board_corners(parse_board(kUsualBoard));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d p = camera.pose.rotation * corners[i] + camera.pose.translation;
    const Lens& lens = camera.lens;
    seen.corners.emplace_back(corners[i].x(), corners[i].y(), corners[i].z());
    seen.points.emplace_back(lens.fx * p.x() / p.z() + lens.cx + random.gaussian(0.05),
                             lens.fy * p.y() / p.z() + lens.cy + random.gaussian(0.05));
  }
  return seen;
}

double degrees_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.rotation * b.rotation.transpose()).angle() * 180 / M_PI;
}

TEST_CASE("A pose does not follow corners beside which a shadow or the object lies") {
  Lens lens = testing::usual_lens();
  lens.distortion = {0, 0, 0, 0, 0};
  cv::RNG random(5);
  for (const testing::BoardCamera& camera : testing::turntable_before(lens, 6)) {
    SeenBoard seen = seen_by(camera, random);
    const std::optional<BoardPose> clean = pose_by_board(seen, lens);
    REQUIRE(clean);
    CHECK(degrees_between(clean->pose, camera.pose) < 0.05);
    CHECK(clean->corners == seen.points.size());
    seen.points[3].x += 1.5;
    seen.points[10].y -= 0.8;
    const std::optional<BoardPose> disturbed = pose_by_board(seen, lens);
    REQUIRE(disturbed);
    CHECK(degrees_between(disturbed->pose, camera.pose) < 0.05);
    CHECK(disturbed->corners == seen.points.size() - 2);
    CHECK(disturbed->error_px < 0.15);
  }
}

TEST_CASE("Where two poses explain the few corners that are seen, those of markers tell which") {
  Lens lens = testing::usual_lens(3000);
  lens.distortion = {0, 0, 0, 0, 0};
  cv::RNG random(7);
  const testing::BoardCamera camera = testing::turntable_before(lens, 5, 12000)[2];
  SeenBoard seen = seen_by(camera, random);
  SeenBoard few;
  for (const std::size_t i : {0U, 1U, 2U, 6U, 7U, 8U}) {
    few.corners.push_back(seen.corners[i]);
    few.points.push_back(seen.points[i]);
  }
  const std::optional<BoardPose> by_corners = pose_by_board(few, lens);
  REQUIRE(by_corners);
  CHECK(by_corners->ambiguous);
  // Markers all over the board.
  for (const double x : {-105.0, -60.0, 0.0, 60.0, 105.0}) {
    for (const double y : {-75.0, 0.0, 75.0}) {
      const Eigen::Vector3d p = camera.pose.rotation * Eigen::Vector3d(x, y, 0) + camera.pose.translation;
      few.marker_corners.emplace_back(x, y, 0);
      few.marker_points.emplace_back(lens.fx * p.x() / p.z() + lens.cx, lens.fy * p.y() / p.z() + lens.cy);
    }
  }
  const std::optional<BoardPose> by_all = pose_by_board(few, lens);
  REQUIRE(by_all);
  CHECK_FALSE(by_all->ambiguous);
  CHECK(degrees_between(by_all->pose, camera.pose) < 0.5);
}

}  // namespace
}  // namespace nef::visual_hull
