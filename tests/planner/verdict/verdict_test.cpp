// SPDX-License-Identifier: Apache-2.0
//
// Verdicts on parts: distances and overlaps against Booleans and nef::distance, removals by sweeping the part, what is
// stuck against its stops; known assemblies, and the program.
#include "apps/planner/verdict/verdict.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/minkowski/morphology.h"
#include "apps/program/reports/exact_json.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/report_shape.h"

namespace nef::planner::test {
namespace {

using Status = PartVerdict::Status;

Assembly assembly_of(std::vector<Polyhedron> parts) {
  Assembly assembly;
  for (std::size_t i = 0; i < parts.size(); ++i) assembly.names.push_back(std::to_string(i));
  assembly.parts = std::move(parts);
  return assembly;
}

Assembly load_assembly(const std::string& name) {
  return read_assembly(source_folder() + "/data/planner/assembly/" + name + ".json");
}

// A polygonal ball.
Polyhedron ball(int splits, const Rational3& at) {
  return transform(minkowski::inner_ball(1, splits), AffineMap::translate(at));
}

// Nothing if what is told of each pair and each part is so.
std::string complaint(const Assembly& assembly, const PartsVerdict& found) {
  std::size_t at = 0;
  for (std::size_t a = 0; a < assembly.parts.size(); ++a) {
    for (std::size_t b = a + 1; b < assembly.parts.size(); ++b, ++at) {
      const PairVerdict& pair = found.pairs.at(at);
      if (pair.a != a || pair.b != b) return "another pair";
      const Distance truth = *distance(assembly.parts[a], assembly.parts[b]);
      if (pair.distance.contact != truth.contact) return "another contact";
      if (pair.distance.squared != truth.squared) return "another distance";
      const Rational3 gap = minus(pair.distance.on_a, pair.distance.on_b);
      if (dot(gap, gap) != truth.squared) return "the points have another distance";
      if (!contains(assembly.parts[a], pair.distance.on_a) || !contains(assembly.parts[b], pair.distance.on_b))
        return "a point is not on its part";
      const bool overlaps = truth.contact == nef::Contact::kOverlapping;
      if (overlaps != pair.interference.has_value()) return "another overlap";
      if (!overlaps) continue;
      const Polyhedron common = intersect(assembly.parts[a], assembly.parts[b]);
      const Rational exact = *volume(common);
      if (pair.interference->exact_volume != exact) return "another volume";
      if (abs(exact - exact_rational(pair.interference->volume.value)) >
          exact_rational(pair.interference->volume.error))
        return "a wrong bound of the volume";
      if (!equal(closure(pair.interference->region), closure(regularize(common)))) return "another region";
      if (pair.interference->box != *bounding_box(regularize(common))) return "another box";
    }
  }
  for (std::size_t part = 0; part < assembly.parts.size(); ++part) {
    const PartVerdict& judged = found.parts.at(part);
    std::vector<Polyhedron> rest;
    for (std::size_t other = 0; other < assembly.parts.size(); ++other) {
      if (other != part) rest.push_back(assembly.parts[other]);
    }
    const Polyhedron others = unite_all(rest);
    const Polyhedron inside = interior(assembly.parts[part]);
    if ((judged.status == Status::kOverlapping) == intersect(inside, interior(others)).is_empty() && !rest.empty()) {
      return "another overlap of a part";
    }
    if (judged.status == Status::kRemovable) {
      const Rational3& d = *judged.direction;
      const Rational far = 100;
      const Polyhedron way = make_segment(Rational3{}, {far * d[0], far * d[1], far * d[2]});
      if (!intersect(minkowski::minkowski_sum(inside, way), others).is_empty()) return "not removable";
    }
    if (judged.status == Status::kStuck) {
      if (judged.first.dimension != 0 || judged.first.stops.empty()) return "stuck without stops";
      const Rational step(1, 1000);
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) {
            if (x == 0 && y == 0 && z == 0) continue;
            const AffineMap moved = AffineMap::translate({step * x, step * y, step * z});
            if (intersect(transform(inside, moved), interior(others)).is_empty()) return "not stuck";
          }
        }
      }
    }
  }
  return "";
}

PartsVerdict exact_verdict(const Assembly& assembly) { return verdict(assembly, {true, {}}); }

TEST_CASE("verdict: random boxes and hulls on a grid, against Booleans") {
  std::mt19937 random(11);
  std::array<std::size_t, 4> seen{};
  for (unsigned k = 0; k < seeds(25); ++k) {
    std::vector<Polyhedron> parts;
    for (unsigned i = 0; i < 2 + random() % 3; ++i) {
      const Rational3 low{Rational(random() % 4), Rational(random() % 4), Rational(random() % 4)};
      Polyhedron part =
          make_box(low, {low[0] + 1 + random() % 3, low[1] + 1 + random() % 3, low[2] + 1 + random() % 3});
      if (random() % 3 == 0) {
        for (const Polyhedron& other : parts) part = closure(regularize(subtract(part, other)));
      }
      if (!part.is_empty()) parts.push_back(part);
    }
    if (k % 2 == 0) {
      const AffineMap turn = oblique_rotation();
      for (Polyhedron& part : parts) part = transform(part, turn);
    }
    const Assembly assembly = assembly_of(std::move(parts));
    const PartsVerdict found = exact_verdict(assembly);
    INFO("case " << k);
    CHECK(complaint(assembly, found) == "");
    for (const PartVerdict& part : found.parts) ++seen.at(static_cast<std::size_t>(part.status));
  }
  CHECK(seen[0] > 0);
  CHECK(seen[1] > 0);
}

TEST_CASE("verdict: known assemblies") {
  using Statuses = std::vector<Status>;
  const auto statuses = [](const std::string& name) {
    const Assembly assembly = load_assembly(name);
    const PartsVerdict found = exact_verdict(assembly);
    CHECK(complaint(assembly, found) == "");
    Statuses result;
    for (const PartVerdict& part : found.parts) result.push_back(part.status);
    return result;
  };
  CHECK(statuses("cube_in_a_box") == Statuses{Status::kStuck, Status::kStuck});
  CHECK(statuses("peg") == Statuses{Status::kRemovable, Status::kRemovable});
  CHECK(statuses("rings") == Statuses{Status::kUndecided, Status::kUndecided});
  // The pin holds the lid, and both hold the box.
  CHECK(statuses("lid_and_pin") == Statuses{Status::kStuck, Status::kStuck, Status::kRemovable});
  const Statuses burr = statuses("burr");
  CHECK(std::count(burr.begin(), burr.end(), Status::kRemovable) == 1);
}

TEST_CASE("verdict: balls of 968 triangles that overlap, touch and are apart") {
  const Polyhedron first = ball(11, {});
  for (const Rational3& at : {Rational3{Rational(3, 2), Rational(1, 10), Rational(1, 5)}, Rational3{2, 0, 0},
                              Rational3{Rational(5, 2), Rational(1, 10), Rational(1, 5)}}) {
    const Assembly assembly = assembly_of({first, ball(11, at)});
    const PartsVerdict found = verdict(assembly);
    CHECK(complaint(assembly, exact_verdict(assembly)) == "");
    if (at[0] == 2) {
      CHECK(found.pairs[0].distance.contact == nef::Contact::kTouching);
      CHECK(found.pairs[0].distance.on_a == Rational3{1, 0, 0});
      CHECK(found.parts[0].status == Status::kRemovable);
    }
  }
  // A ball in its own mould: nothing moves.
  const Assembly mould = assembly_of({subtract(make_box({-2, -2, -2}, {2, 2, 2}), interior(ball(4, {}))), ball(4, {})});
  const PartsVerdict found = exact_verdict(mould);
  CHECK(complaint(mould, found) == "");
  CHECK(found.parts[1].status == Status::kStuck);
  CHECK(found.parts[1].first.stops.size() <= 8);
}

TEST_CASE("planner --verdict: reports, exit codes, mechanisms") {
  const Folder folder;
  const std::string data = source_folder() + "/data/planner/assembly/";
  const Run peg = planner(folder, "--verdict " + data + "peg.json --json -o " + folder.file("v.json"));
  CHECK(peg.code == 0);
  CHECK(peg.out == text_of(folder.file("v.json")));
  const nlohmann::json report = nlohmann::json::parse(peg.out);
  nef::test::check_report_shape(report, "verdict");
  CHECK(report["status"] == "clear");
  CHECK(report["smallest_gap"] == nullptr);
  REQUIRE(report["pairs"].size() == 1);
  CHECK(report["pairs"][0]["contact"] == "touching");
  CHECK(report["parts"][1]["status"] == "removable");
  CHECK(report["parts"][1]["direction"] == nlohmann::json{"0", "0", "1"});
  const std::string overlap = folder.write(
      "o.json", R"J({"parts": {"a": "box(0,0,0,2,2,2)", "b": "box(1,1,1,3,3,3)", "c": "box(5,0,0,6,1,1)"}})J");
  const Run bad = planner(folder, "--verdict " + overlap);
  CHECK(bad.code == 3);
  CHECK(bad.out ==
        "a and b overlap: volume 1, in the box from 1,1,1 to 2,2,2\n"
        "b and c: distance 2.0, from 3,1,1 to 5,1,1\n"
        "a: overlapping\nb: overlapping\nc: removable along 0,-1,0\n");
  CHECK(nlohmann::json::parse(
            planner(folder, "--exact --json --verdict " + overlap).out)["pairs"][0]["overlap"]["volume"] == "1");
  const std::string door =
      folder.write("door.json", R"J({"moving": "box(0,0,0, 3,1/5,2)", "fixed": ["box(2,1,0, 3,2,1)"],
    "joint": {"type": "hinge", "axis": "z", "range": [0, 90]}})J");
  const Run hinge = planner(folder, "--verdict " + door + " --json");
  CHECK(hinge.code == 0);
  const nlohmann::json moves = nlohmann::json::parse(hinge.out);
  CHECK(moves["pairs"][0]["squared"] == "16/25");
  CHECK(moves["range"]["parts"].size() == 5);
  CHECK(planner(folder, "--verdict " + overlap + " --tight").code == 2);
  CHECK(planner(folder, "--verdict " + folder.write("bad.json", "[]")).code == 2);
  CHECK(planner(folder, "--exact --range " + door).code == 2);
}

}  // namespace
}  // namespace nef::planner::test
