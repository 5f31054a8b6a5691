// SPDX-License-Identifier: Apache-2.0
//
// Proofs that nothing can begin to move: they hold where every set of parts is blocked, there are none elsewhere, and
// what is changed in one is refused.
#include "apps/planner/proofs/inseparable_proof.h"

#include <catch2/catch.hpp>

#include "apps/planner/assembly/disassembly.h"
#include "nef/base/error.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

Assembly assembly_of(const std::string& parts) { return parse_assembly("{\"parts\": " + parts + "}", "", "test"); }

PartSet all_of(const Assembly& assembly) {
  PartSet all;
  for (std::size_t i = 0; i < assembly.parts.size(); ++i) all.push_back(i);
  return all;
}

// A tetrahedron in two parts, in a mould that its planes fill.
Assembly mould(const AffineMap& map = AffineMap::identity()) {
  Assembly assembly = assembly_of(R"J({"mould": "box(-1,-1,-1, 4,4,4) - hull(0,0,0, 3,0,0, 0,3,0, 0,0,3)",
      "left": "hull(0,0,0, 1,0,0, 0,3,0, 0,0,3)", "right": "hull(1,0,0, 3,0,0, 0,3,0, 0,0,3)"})J");
  for (Polyhedron& part : assembly.parts) part = transform(part, map);
  return assembly;
}

void check_proof(const Assembly& assembly) {
  const std::optional<InseparableProof> proof = make_inseparable_proof(assembly, all_of(assembly));
  REQUIRE(proof);
  const std::string text = proof_text(*proof);
  const InseparableProof read = parse_inseparable_proof(text, "proof");
  CHECK(proof_text(read) == text);
  CHECK(complaint_about(read).value_or("") == "");
  CHECK(complaint_about(read, assembly).value_or("") == "");
}

TEST_CASE("proofs of inseparable parts hold") {
  check_proof(read_assembly(source_folder() + "/data/planner/assembly/cube_in_a_box.json"));
  check_proof(mould());
  check_proof(mould(oblique_rotation()));
  // Shears make blocked cones narrow.
  AffineMap shear = AffineMap::identity();
  shear.linear[0][2] = 3;
  shear.linear[1][0] = Rational(5, 2);
  check_proof(mould(shear));
}

TEST_CASE("there are no proofs where something can begin to move") {
  for (const char* name : {"tray", "lid_and_pin", "peg", "dovetail", "rings"}) {
    const Assembly assembly = read_assembly(source_folder() + "/data/planner/assembly/" + name + ".json");
    CHECK_FALSE(make_inseparable_proof(assembly, all_of(assembly)));
  }
  // The cube can slide along x; in a mould one side of which is open, both parts can leave.
  const Assembly tunnel = assembly_of(R"J({"a": "box(0,0,0, 3,3,3) - box(0,1,1, 3,2,2)", "b": "box(1,1,1, 2,2,2)"})J");
  CHECK_FALSE(make_inseparable_proof(tunnel, all_of(tunnel)));
}

TEST_CASE("changed proofs of inseparable parts are refused") {
  const Assembly assembly = mould();
  const InseparableProof proof = *make_inseparable_proof(assembly, all_of(assembly));
  {
    InseparableProof changed = proof;
    changed.parts[1].pieces[0][0][0] += Rational(1, 1000);
    CHECK((complaint_about(changed) || complaint_about(changed, assembly)));
    changed = proof;
    changed.parts[1].name = "other";
    CHECK(complaint_about(changed, assembly));
    changed = proof;
    changed.parts.pop_back();
    CHECK(complaint_about(changed));
  }
  for (std::size_t i = 0; i < proof.contacts.size(); ++i) {
    InseparableProof changed = proof;
    changed.contacts[i].common.robot[0] += Rational(1, 7);
    CHECK(complaint_about(changed));
    changed = proof;
    changed.contacts[i].second.part = changed.contacts[i].first.part;
    CHECK(complaint_about(changed));
    changed = proof;
    changed.contacts[i].first.piece = 1000;
    CHECK(complaint_about(changed));
  }
  for (std::size_t octant = 0; octant < 8; ++octant) {
    InseparableProof changed = proof;
    InseparableProof::Cone* cone = &changed.octants[octant];
    while (cone->edge) cone = &cone->halves[0];
    const InseparableProof::Cone leaf = *cone;
    cone->first_blocked.clear();
    cone->second_blocked.clear();
    CHECK(complaint_about(changed));
    *cone = leaf;
    std::swap(cone->first_blocked, cone->second_blocked);
    CHECK(complaint_about(changed));
    *cone = leaf;
    cone->first_blocked.push_back(1000);
    CHECK(complaint_about(changed));
  }
  const std::string text = proof_text(proof);
  for (const auto& [from, to] :
       {std::pair("\"inseparable\"", "\"path\""), std::pair("\"nef_proof\":1", "\"nef_proof\":2"),
        std::pair("\"1\"", "1"), std::pair("\"octants\"", "\"octant\"")}) {
    std::string other = text;
    const std::size_t at = other.find(from);
    REQUIRE(at != std::string::npos);
    other.replace(at, std::string(from).size(), to);
    CHECK_THROWS_AS(parse_inseparable_proof(other, "proof"), InputError);
  }
}

TEST_CASE("planner --assembly --proof and --check-proof") {
  const Folder folder;
  const std::string data = source_folder() + "/data/planner/assembly/";
  const std::string proof = folder.file("stuck.proof");
  CHECK(planner(folder, "--assembly " + data + "cube_in_a_box.json --proof " + proof).code == 1);
  const Run held = planner(folder, "--assembly " + data + "cube_in_a_box.json --check-proof " + proof);
  CHECK(held.code == 0);
  CHECK(held.out == "the proof holds: inseparable, box, cube\n");
  CHECK(planner(folder, "--assembly " + data + "peg.json --check-proof " + proof).code == 1);
  CHECK(planner(folder, scene("s1_tight_hole") + " --check-proof " + proof).code == 2);
  for (const char* name : {"peg", "rings"}) {
    const Run none = planner(folder, "--assembly " + data + name + ".json --proof " + folder.file("none.proof"));
    CHECK(none.code == 2);
    CHECK_THAT(none.err, Catch::Contains("--proof"));
    CHECK_FALSE(std::filesystem::exists(folder.file("none.proof")));
  }
}

}  // namespace
}  // namespace nef::planner::test
