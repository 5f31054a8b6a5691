// SPDX-License-Identifier: Apache-2.0
//
// Paths of linkages: files, certificates, the program and what it shows, against places by trigonometry.
#include "apps/planner/linkage/linkage_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "apps/planner/linkage_urdf/urdf_robot.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/construct/construct.h"
#include "tests/planner/command_helpers.h"
#include "tests/support/report_shape.h"

namespace nef::planner::test::linkage_paths {
namespace {

using Status = MotionVerdict::Status;
using nlohmann::json;

// A bar from the origin to x = 2 that turns about z, among boxes.
LinkageChecker bar_among(const std::vector<std::array<Rational3, 2>>& boxes) {
  Linkage robot;
  robot.links.push_back({"base", std::nullopt, {}});
  const Rational half(1, 8);
  robot.links.push_back(
      {"bar", RigidBody::of_set(make_box({0, -half, -half}, {2, half, half})), {LinkageJoint::Kind::kRevolute}});
  std::vector<RigidBody> obstacles;
  for (const auto& [low, high] : boxes) obstacles.push_back(RigidBody::of_set(make_box(low, high)));
  return {robot, RigidBody::together(obstacles)};
}

// What is drawn of a node of a glTF file: the middle of its points at each time of its animation.
class Shown {
 public:
  explicit Shown(const std::string& file) : bytes_(text_of(file)) {
    REQUIRE(bytes_.substr(0, 4) == "glTF");
    const std::size_t length = number(12);
    gltf_ = json::parse(bytes_.substr(20, length));
    binary_ = 20 + length + 8;
  }

  [[nodiscard]] std::vector<Vector3d> places(const std::string& node) const {
    const json& nodes = gltf_["nodes"];
    const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const json& n) { return n["name"] == node; });
    REQUIRE(found != nodes.end());
    const json& points = gltf_["accessors"][mesh_of(*found)["primitives"][0]["attributes"]["POSITION"].get<int>()];
    Vector3d middle;
    for (int k = 0; k < 3; ++k) middle[k] = (points["min"][k].get<double>() + points["max"][k].get<double>()) / 2;
    // A node that turns does so about a pivot, to which an inner node moves its points.
    const json& inner = nodes[(*found)["children"][0].get<int>()];
    const json back = inner.value("translation", json{0, 0, 0});
    for (int k = 0; k < 3; ++k) middle[k] += back[k].get<double>();
    const auto shifts = outputs(found - nodes.begin(), "translation", 3);
    const auto turns = outputs(found - nodes.begin(), "rotation", 4);
    REQUIRE(shifts.size() == turns.size());
    std::vector<Vector3d> result;
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      const Eigen::Quaterniond q(turns[i][3], turns[i][0], turns[i][1], turns[i][2]);
      CHECK(q.norm() == Approx(1).margin(1e-5));
      result.emplace_back(q * middle + Vector3d(shifts[i][0], shifts[i][1], shifts[i][2]));
    }
    return result;
  }
  [[nodiscard]] bool moves() const { return gltf_.contains("animations"); }

 private:
  [[nodiscard]] std::size_t number(std::size_t at) const {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + at, 4);
    return value;
  }
  [[nodiscard]] const json& mesh_of(const json& node) const {
    if (node.contains("mesh")) return gltf_["meshes"][node["mesh"].get<int>()];
    REQUIRE(node.contains("children"));
    return mesh_of(gltf_["nodes"][node["children"][0].get<int>()]);
  }
  [[nodiscard]] std::vector<std::vector<double>> outputs(std::ptrdiff_t node, const std::string& path,
                                                         std::size_t width) const {
    std::vector<std::vector<double>> result;
    REQUIRE(gltf_["animations"].size() == 1);
    for (const json& channel : gltf_["animations"][0]["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      const json& sampler = gltf_["animations"][0]["samplers"][channel["sampler"].get<int>()];
      const json& accessor = gltf_["accessors"][sampler["output"].get<int>()];
      const json& view = gltf_["bufferViews"][accessor["bufferView"].get<int>()];
      std::size_t at =
          binary_ + view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
      for (int i = 0; i < accessor["count"].get<int>(); ++i) {
        std::vector<double>& row = result.emplace_back();
        for (std::size_t k = 0; k < width; ++k, at += 4) {
          float x = 0;
          std::memcpy(&x, bytes_.data() + at, 4);
          row.push_back(x);
        }
      }
    }
    return result;
  }

  std::string bytes_;
  json gltf_;
  std::size_t binary_ = 0;
};

}  // namespace

TEST_CASE("a path of a linkage is certified motion by motion") {
  const LinkageChecker checker = bar_among({{{{1, 1, -1}, {2, 2, 1}}}});  // from 26.6 to 63.4 degrees, about
  const std::vector<std::vector<double>> good{{-1}, {0.2}, {-3}, {-5}};
  CHECK(certify(checker, good).status == Status::kFree);
  CHECK(certify(checker, good).motions.size() == 3);
  const std::vector<std::vector<double>> bad{{-1}, {0.2}, {1.5}, {0.2}};
  const CertifiedLinkagePath found = certify(checker, bad);
  CHECK(found.status == Status::kCollides);
  CHECK(found.blocked == 1);
  CHECK(found.motions[0].status == Status::kFree);
  CHECK(certify(checker, std::vector<std::vector<double>>{{0.7}}).status == Status::kCollides);
  CHECK(certify(checker, std::vector<std::vector<double>>{{0}}).status == Status::kFree);
  CHECK_THROWS_AS(certify(checker, {}), InputError);
  CHECK_THROWS_AS(certify(checker, std::vector<std::vector<double>>{{1, 2}}), InputError);
  CHECK_THROWS_AS(certify(checker, std::vector<std::vector<double>>{{NAN}}), InputError);

  std::vector<std::size_t> done;
  const ProgressFunction told = [&](const char* /*phase*/, std::size_t i, std::size_t total) {
    CHECK(total == 3);
    done.push_back(i);
  };
  certify(checker, good, {}, Monitor().telling(told));
  CHECK(done == std::vector<std::size_t>{0, 1, 2});
  const std::atomic<bool> stop{true};
  CHECK_THROWS_AS(certify(checker, good, {}, Monitor().stopped_by(&stop)), Interrupted);
}

TEST_CASE("files of joint values, and one line for each mistake in them") {
  const Folder folder;
  const std::vector<std::string> joints{"slew", "luff"};
  CHECK(read_joint_path(folder.write("a.txt", "0 1/4\n\n-1.5, 2e-1\n"), joints) ==
        std::vector<std::vector<double>>{{0, 0.25}, {-1.5, 0.2}});
  CHECK(read_joint_path(folder.write("a.json", R"({"path": [[0, "1/4"], [0.1, 3]]})"), joints) ==
        std::vector<std::vector<double>>{{0, 0.25}, {0.1, 3}});
  for (const char* bad : {"", "0 1 2\n", "0 x\n", "1e999 0\n", "{}", R"({"path": [[0]]})", R"({"path": 7})"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(read_joint_path(folder.write("bad.txt", bad), joints), InputError);
  }
  CHECK_THROWS_WITH(read_joint_path(folder.write("bad.txt", "0 1\n0\n"), joints),
                    Catch::Contains("bad.txt:2: expected 2 values (slew, luff), not 1"));
}

TEST_CASE("the program certifies a path of a crane, and shows it moving") {
  if (!reads_urdf()) return;
  const Folder folder;
  const std::string data = source_folder() + "/data/planner/linkage/crane.";
  const std::string crane =
      "--linkage " + data + "urdf --srdf " + data + "srdf --obstacle 'box(3,-1,1, 4,1,3)' --path ";
  const std::string quarter = std::to_string(M_PI / 2);
  const std::string swing = folder.write("swing.txt", quarter + " 0 1\n-" + quarter + " 0 1\n");
  const Run hits = planner(folder, crane + swing + " --json");
  CHECK(hits.code == 1);
  const json report = json::parse(hits.out);
  nef::test::check_report_shape(report, "linkage");
  CHECK(report["status"] == "blocked");
  CHECK(report["blocked_segment"] == 0);
  CHECK(report["joints"] == json({"slew", "luff", "reach"}));
  // The hook hangs 3.25 from the axis, so it is in the box where |sin slew| is small.
  const json& collision = report["verdicts"][0]["collision"];
  CHECK(std::fabs(collision["values"][0].get<double>()) < 0.5);
  CHECK(collision["links"][1].is_null());
  CHECK(planner(folder, crane + swing).out.find("blocked: motion 0, link ") == 0);

  const std::string round =
      folder.write("round.txt", quarter + " 0 1\n" + quarter + " 0 0\n-" + quarter + " 0 0\n-" + quarter + " 0 1\n");
  const Run free = planner(folder, crane + round + " -o " + folder.file("r.glb") + " -o " + folder.file("r.json") +
                                       " --page " + folder.file("r.html"));
  CHECK(free.code == 0);
  CHECK(free.out == "path: all 3 motions are free\n");
  // What a report says can be asked again.
  CHECK(planner(folder, crane + folder.file("r.json")).code == 0);
  CHECK_THAT(text_of(folder.file("r.html")), Catch::StartsWith("<!DOCTYPE html>"));
  const Shown shown(folder.file("r.glb"));
  const std::vector<Vector3d> hook = shown.places("hook");
  const std::vector<Vector3d> boom = shown.places("boom");
  REQUIRE(hook.size() > 40);  // half a turn in steps of a few degrees
  REQUIRE(boom.size() == hook.size());
  CHECK(shown.places("ground").empty());
  // From (0, 3.25) over (0, 2.25), half a turn, to (0, -3.25), as seen from above; the boom's middle is 1.25 from the
  // mast, 0.75 higher than the hook's.
  CHECK((hook.back() - hook.front()).norm() == Approx(6.5).epsilon(1e-4));
  CHECK((boom.back() - boom.front()).norm() == Approx(2.5).epsilon(1e-4));
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < hook.size(); ++i) {
    const double apart = (hook[i] - boom[i]).norm();
    CHECK(apart <= std::hypot(2.0, 0.25) + 1e-4);
    least = std::min(least, apart);
  }
  CHECK(least == Approx(std::hypot(1.0, 0.25)).epsilon(1e-4));
  // Half a turn at 2.25: the ends of the chords are on the circle about the mast.
  const Vector3d mast = (boom.front() + boom.back()) / 2;
  for (const Vector3d& place : boom) CHECK((place - mast).norm() == Approx(1.25).epsilon(1e-4));

  const std::string still = folder.write("still.txt", "0 0 0\n");
  CHECK(planner(folder, crane + still + " -o " + folder.file("s.glb")).code == 0);
  CHECK_FALSE(Shown(folder.file("s.glb")).moves());
}

TEST_CASE("mistakes in a question about a linkage are told in one line") {
  if (!reads_urdf()) return;
  const Folder folder;
  const std::string data = source_folder() + "/data/planner/linkage/crane.urdf";
  const std::string still = folder.write("still.txt", "0 0 0\n");
  const std::string beyond = folder.write("beyond.txt", "0 0 0\n9 0 2\n");
  struct Bad {
    std::string arguments;
    std::string word;
  };
  for (const Bad& bad : std::vector<Bad>{
           {"--linkage " + data, "--linkage needs --path"},
           {"--linkage " + data + " --path " + beyond,
            "way-point 1: the value 2 of joint 'reach' is not within its limits, 0 to 1.5"},
           {"--linkage " + data + " --path " + still + " --obstacle none.off", "none.off"},
           {"--linkage " + data + " --path " + still + " -o a.csv", "-o a.csv"},
           {"--linkage " + data + " --path " + still + " --proof a.proof", "--linkage excludes --proof"},
           {"--linkage " + data + " --path " + still + " " + scene("s1_tight_hole"), "--linkage excludes a scene"},
           {"--srdf a.srdf " + scene("s1_tight_hole"), "are for --linkage"},
           {"--linkage none.urdf --path " + still, "none.urdf"},
       }) {
    CAPTURE(bad.arguments);
    const Run run = planner(folder, bad.arguments);
    CHECK(run.code == 2);
    CHECK_THAT(run.err, Catch::Contains(bad.word));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
}

}  // namespace nef::planner::test::linkage_paths
