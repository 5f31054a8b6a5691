// SPDX-License-Identifier: Apache-2.0
//
// What pages show of a range: the moving part where the joint has it, as known from circles, lines and bars.
#include "apps/planner/command/runs/parts/range_view.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/planner/command_helpers.h"

namespace nef::planner::test::range_view {
namespace {

view::Motion shown(const std::string& text) {
  const Mechanism m = parse_mechanism(text, "", "test");
  const std::vector<view::Layer> layers = range_layers(nef::planner::range_of_motion(m), m);
  REQUIRE(layers.size() == 1 + m.fixed.size());
  CHECK(layers[0].name == "moving");
  CHECK(layers[1].motion.empty());
  const view::Motion& motion = layers[0].motion;
  for (std::size_t i = 0; i + 1 < motion.times.size(); ++i) CHECK(motion.times[i] < motion.times[i + 1]);
  CHECK(motion.turns.size() == motion.times.size());
  return motion;
}

Eigen::Vector3d at(const view::Motion& motion, std::size_t i, const Eigen::Vector3d& point) {
  const auto vector = [](const view::Point& p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  const auto& [w, x, y, z] = motion.turns[i];
  return Eigen::Quaterniond(w, x, y, z) * (point - vector(motion.pivot)) + vector(motion.pivot) +
         vector(motion.offsets[i]);
}

bool is_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() < 1e-9; }

Eigen::Vector3d on_circle(double radius, double degrees, double z) {
  return {radius * std::cos(degrees * M_PI / 180), radius * std::sin(degrees * M_PI / 180), z};
}

TEST_CASE("a door plays the longer one of its two free stretches", "[mechanism]") {
  const view::Motion motion = shown(R"J({"moving": "box(1,1,0, 4,6/5,2)", "fixed": ["box(3,2,0, 4,3,1)"],
      "joint": {"type": "hinge", "axis": "z", "point": [1, 1, 5], "range": [0, 90]}})J");
  REQUIRE(motion.times.size() > 10);  // 45 degrees in steps of at most 4
  CHECK(motion.times.front() == 0);
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    const double degrees = 45 + 45 * motion.times[i] / motion.times.back();
    CHECK(is_near(at(motion, i, {4, 1, 2}), Eigen::Vector3d(1, 1, 0) + on_circle(3, degrees, 2)));
  }
}

TEST_CASE("a screw goes evenly with its angle", "[mechanism]") {
  const view::Motion motion = shown(R"J({"moving": "box(-1,-1,0, 1,1,1)", "fixed": ["box(8,8,8, 9,9,9)"],
      "joint": {"type": "screw", "axis": "z", "pitch": 3, "range": [-90, 720]}})J");
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    const double degrees = -90 + 810 * motion.times[i] / motion.times.back();
    CHECK(is_near(at(motion, i, {1, 0, 0}), on_circle(1, degrees, degrees / 120)));
  }
}

TEST_CASE("a slider goes straight up to what it touches", "[mechanism]") {
  const view::Motion motion = shown(R"J({"moving": "box(0,0,0, 1,1,1)", "fixed": ["box(4,0,0, 5,1,1)"],
      "joint": {"type": "slider", "direction": [2, 0, 0], "range": [-1, 1.25]}})J");
  REQUIRE(motion.times.size() == 2);
  CHECK(is_near(at(motion, 0, {1, 1, 1}), {-1, 1, 1}));
  CHECK(is_near(at(motion, 1, {1, 1, 1}), {3.5, 1, 1}));
  CHECK(shown(R"J({"moving": "box(0,0,0, 1,1,1)", "fixed": ["box(0,0,0, 9,1,1)"],
      "joint": {"type": "slider", "direction": "x", "range": [0, 2]}})J")
            .empty());
}

TEST_CASE("the pins of a coupler stay on the circles of both bars", "[mechanism]") {
  const view::Motion motion = shown(R"J({"moving": "box(0,1,0, 4,3/2,1)", "fixed": ["box(0,0,8, 1,1,9)"],
      "joint": {"type": "four-bar", "axis": "z", "pivots": [[0,0,0], [4,0,0]], "pins": [[0,1,0], [4,3,0]],
      "moves": "coupler", "range": [0, 360]}})J");
  REQUIRE(motion.times.size() > 80);
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    const double degrees = 90 + 360 * motion.times[i] / motion.times.back();
    CHECK(is_near(at(motion, i, {0, 1, 0}), on_circle(1, degrees, 0)));
    CHECK(std::fabs((at(motion, i, {4, 3, 0}) - Eigen::Vector3d(4, 0, 0)).norm() - 3) < 1e-9);
  }
}

TEST_CASE("the program writes a page and a glTF file of a range", "[mechanism]") {
  const Folder folder;
  const std::string door = folder.write(
      "door.json",
      R"J({"moving": "box(0,0,0, 3,1/5,2)", "fixed": ["box(2,1,0, 3,2,1)"], "joint": {"type": "hinge", "axis": "z", "range": [0, 90]}})J");
  const Run run = planner(folder, "--range " + door + " -q -o " + folder.file("door.glb"));
  CHECK(run.code == 0);
  CHECK(run.err.empty());
  CHECK(text_of(folder.file("door.glb")).find("\"animations\"") != std::string::npos);
}

}  // namespace
}  // namespace nef::planner::test::range_view
