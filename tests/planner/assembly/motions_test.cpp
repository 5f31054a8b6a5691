// SPDX-License-Identifier: Apache-2.0
//
// Parts that leave in other ways than by one translation: with turns, in different directions at once, with a
// clearance; and what of an assembly is interlocked. Steps are swept or certified anew.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/clearance/clear_disassembly.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "apps/planner/rigid/certified_path.h"
#include "nef/distance/distance.h"
#include "tests/planner/command_helpers.h"
#include "tests/support/report_shape.h"

namespace nef::planner::test {
namespace {

std::string data_file(const std::string& name) { return source_folder() + "/data/planner/assembly/" + name + ".json"; }

Polyhedron union_of(const Assembly& assembly, const PartSet& set) {
  std::vector<Polyhedron> parts;
  for (const std::size_t part : set) parts.push_back(assembly.parts[part]);
  return unite_all(parts);
}

// Every motion of a step that turns is free, and at its end the boxes are apart.
void check_turning(const Assembly& assembly, const DisassemblyStep& step) {
  REQUIRE(step.turning.has_value());
  const AffineMap back =
      AffineMap::translate({-step.turning->pivot[0], -step.turning->pivot[1], -step.turning->pivot[2]});
  Scene scene;
  scene.robot = transform(union_of(assembly, step.parts), back);
  scene.obstacles = {transform(union_of(assembly, step.stay), back)};
  scene.obstacle_names = {"others"};
  const CertifiedPath certified = certify(MotionChecker::of_scene(scene), step.turning->poses);
  CHECK(certified.status == MotionVerdict::Status::kFree);
  CHECK(step.turning->poses.front().position == Rational3{});
  CHECK(step.turning->poses.size() == step.path.size());
  const auto mine = *bounding_box(transform(scene.robot, map_of(step.turning->poses.back())));
  const auto theirs = *bounding_box(scene.obstacles.front());
  bool apart = false;
  for (std::size_t k = 0; k < 3; ++k) apart = apart || mine[0][k] >= theirs[1][k] || mine[1][k] <= theirs[0][k];
  CHECK(apart);
}

TEST_CASE("a bayonet turns and leaves, and without turns it is inseparable") {
  Assembly bayonet = read_assembly(data_file("bayonet"));
  REQUIRE(bayonet.turning_axis.has_value());
  const Disassembly answer = take_apart(bayonet);
  REQUIRE(answer.steps.size() == 1);
  CHECK(answer.inseparable.empty());
  check_turning(bayonet, answer.steps.front());
  Assembly freely = bayonet;
  freely.turning_axis.reset();
  CHECK(take_apart(freely).inseparable.size() == 1);
  freely.turns_freely = true;
  const Disassembly by_any_axis = take_apart(freely);
  REQUIRE(by_any_axis.steps.size() == 1);
  check_turning(freely, by_any_axis.steps.front());
}

TEST_CASE("a part that turns in its closed box stays there, which is proved about one axis") {
  const Assembly closed = parse_assembly(
      R"J({"parts": {"box": "box(-3,-3,-3, 3,3,3) - box(-2,-2,-2, 2,2,2)", "bar": "box(-1,-1,-1, 1,1,1)"},
           "rotation": {"axis": "z"}})J",
      "", "closed");
  const Disassembly answer = take_apart(closed);
  CHECK(answer.steps.empty());
  REQUIRE(answer.inseparable.size() == 1);
  CHECK_FALSE(answer.inseparable.front().nothing_moves);
}

TEST_CASE("parts that may turn are undecided where neither a way nor a proof is found") {
  // A ball-like part in contact all around: a way must keep contact while it turns.
  const Assembly tight = parse_assembly(
      R"J({"parts": {"box": "box(-3,-3,-3, 3,3,3) - box(-1,-1,-1, 1,1,1)", "cube": "box(-1,-1,-1, 1,1,1)"},
           "rotation": "SO(3)"})J",
      "", "tight");
  const Disassembly answer = take_apart(tight, {.digits = {}, .max_cells = 20});
  CHECK(answer.steps.empty());
  CHECK(answer.inseparable.size() + answer.undecided.size() == 1);
}

TEST_CASE("six tetrahedra cannot be taken apart with two hands, but all at once") {
  const Assembly six = read_assembly(data_file("six_tetrahedra"));
  const Disassembly two_hands = take_apart(six);
  REQUIRE(two_hands.inseparable.size() == 1);
  CHECK(two_hands.inseparable.front().nothing_moves);
  CHECK(two_hands.inseparable.front().interlocked.size() == 6);
  const Disassembly at_once = take_apart(six, {.digits = {}, .simultaneous = true});
  CHECK(at_once.inseparable.empty());
  REQUIRE(at_once.steps.size() == 1);
  const DisassemblyStep& step = at_once.steps.front();
  CHECK(step.parts.size() == 5);
  CHECK(step.stay.size() == 1);
  CHECK(step.path.empty());
  REQUIRE(step.vectors.size() == 5);
  // Seen from any one part, each other one sweeps a straight way clear of it, and is beyond it in the end.
  std::vector<Rational3> vectors(6);
  for (std::size_t i = 0; i < 5; ++i) vectors[step.parts[i]] = step.vectors[i];
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      Rational3 d;
      for (std::size_t k = 0; k < 3; ++k) d[k] = vectors[a][k] - vectors[b][k];
      const Polyhedron swept = minkowski::minkowski_sum(interior(six.parts[a]), make_segment({}, d));
      CHECK(intersect(swept, six.parts[b]).is_empty());
    }
  }
}

TEST_CASE("parts that hold each other are told, as few as possible") {
  // Two cubes in cavities of their own, and a lid that only lies there.
  const Assembly cavities = parse_assembly(
      R"J({"parts": {"block": "box(0,0,0, 7,3,3) - box(1,1,1, 2,2,2) - box(4,1,1, 5,2,2)",
                     "left": "box(1,1,1, 2,2,2)", "right": "box(4,1,1, 5,2,2)", "lid": "box(0,0,3, 7,3,4)"}})J",
      "", "cavities");
  const Disassembly answer = take_apart(cavities);
  CHECK(answer.steps.size() == 1);
  REQUIRE(answer.inseparable.size() == 1);
  const Inseparable& stuck = answer.inseparable.front();
  CHECK(stuck.parts.size() == 3);
  CHECK(stuck.interlocked.size() == 2);
  CHECK(stuck.interlocked_is_least);
  const std::optional<InseparableProof> proof = make_inseparable_proof(cavities, stuck.interlocked);
  REQUIRE(proof.has_value());
  CHECK_FALSE(complaint_about(*proof, cavities).has_value());
  const Folder folder;
  const std::string file =
      folder.write("cavities.json", R"J({"parts": {"block": "box(0,0,0, 7,3,3) - box(1,1,1, 2,2,2) - box(4,1,1, 5,2,2)",
                     "left": "box(1,1,1, 2,2,2)", "right": "box(4,1,1, 5,2,2)", "lid": "box(0,0,3, 7,3,4)"}})J");
  const Run run = planner(folder, "--assembly " + file + " --json --proof " + folder.file("stuck.proof"));
  CHECK(run.code == 1);
  const nlohmann::json report = nlohmann::json::parse(run.out);
  CHECK(report["inseparable"][0]["interlocked"].size() == 2);
  CHECK(report["inseparable"][0]["interlocked_is_least"] == true);
  CHECK(planner(folder, "--assembly " + file + " --check-proof " + folder.file("stuck.proof")).code == 0);
}

TEST_CASE("an assembly comes apart with a clearance up to its gap, and is too close beyond") {
  const Assembly loose = parse_assembly(
      R"J({"parts": {"frame": "box(0,0,0, 9,5,5) - box(1,1,1, 9,4,4)",
                     "slider": "box(11/10,11/10,11/10, 8,39/10,39/10)"}})J",
      "", "loose");
  const Disassembly apart = take_apart_clear(loose, Rational(1, 10));
  REQUIRE(apart.steps.size() == 1);
  CHECK(apart.inseparable.empty());
  CHECK(apart.undecided.empty());
  CHECK(take_apart_clear(loose, Rational(11, 100)).overlap.has_value());
  CHECK_THROWS_AS(take_apart_clear(loose, Rational(0)), InputError);
  // A gap of a tenth on the way, a fifth where the part is.
  const Assembly neck = parse_assembly(
      R"J({"parts": {"frame": "box(0,0,0, 9,5,5) - box(1,1,1, 7,4,4) - box(7,11/10,11/10, 9,39/10,39/10)",
                     "slider": "box(6/5,6/5,6/5, 6,38/10,38/10)"}})J",
      "", "neck");
  CHECK(take_apart_clear(neck, Rational(1, 10)).steps.size() == 1);
  const Disassembly stuck = take_apart_clear(neck, Rational(1, 5));
  CHECK(stuck.steps.empty());
  CHECK(stuck.inseparable.size() == 1);
  // Between the two polytopes nothing is said.
  const Disassembly doubt = take_apart_clear(neck, Rational(11, 100));
  CHECK(doubt.steps.empty());
  CHECK(doubt.undecided.size() == 1);
}

TEST_CASE("planner --assembly: turns, parts that move at once, and clearance in reports, pages and GLB files") {
  const Folder folder;
  const Run turned = planner(folder, "--assembly " + data_file("bayonet") + " --json --page " + folder.file("p.html") +
                                         " -o " + folder.file("p.glb"));
  CHECK(turned.code == 0);
  const nlohmann::json report = nlohmann::json::parse(turned.out);
  nef::test::check_report_shape(report, "assembly");
  CHECK(report["motions"] == "translation and turning");
  const nlohmann::json step = report["steps"][0];
  CHECK(step["turning"]["quaternions"].size() == step["path"].size());
  CHECK(text_of(folder.file("p.glb")).find("\"rotation\"") != std::string::npos);
  CHECK(std::filesystem::file_size(folder.file("p.html")) > 1000);
  CHECK(planner(folder, "--assembly " + data_file("bayonet") + " --proof " + folder.file("x.proof")).code == 2);
  const std::string six = data_file("six_tetrahedra");
  CHECK(planner(folder, "--assembly " + six).code == 1);
  const Run at_once = planner(folder, "--assembly " + six + " --simultaneous --json -o " + folder.file("s.glb"));
  CHECK(at_once.code == 0);
  CHECK(nlohmann::json::parse(at_once.out)["steps"][0]["vectors"].size() == 5);
  CHECK_THAT(planner(folder, "--assembly " + six + " --simultaneous").out,
             Catch::StartsWith("sequence\nat once, in different directions:\n"));
  const std::string pin = data_file("lid_and_pin");
  const Run close = planner(folder, "--assembly " + pin + " --keep-clear 1/10 --json");
  CHECK(close.code == 3);
  CHECK(nlohmann::json::parse(close.out)["status"] == "too_close");
  CHECK(planner(folder, "--assembly " + pin + " --keep-clear 1/10 --proof " + folder.file("x.proof")).code == 2);
  CHECK(planner(folder, "--verdict " + pin + " --simultaneous").code == 2);
  const std::string odd = folder.write("odd.json", R"J({"parts": {"a": "box(0,0,0, 1,1,1)"}, "rotation": "SO(2)"})J");
  const Run wrong = planner(folder, "--assembly " + odd);
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Catch::Contains("rotation"));
}

}  // namespace
}  // namespace nef::planner::test
