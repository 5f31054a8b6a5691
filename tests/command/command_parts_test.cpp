// SPDX-License-Identifier: Apache-2.0
//
// nef section, split, distance, repair; standard input and output; what nef info prints.
#include <array>
#include <filesystem>
#include <sstream>

#include "command/process.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "tests/support/obj_lines.h"
#include "tests/support/paths.h"
#include "tests/support/report_shape.h"

namespace nef::test {
namespace {

// Runs a line of the shell in which NEF is the program.
int shell(const Workplace& here, std::string line) {
  for (std::size_t at = line.find("NEF"); at != std::string::npos; at = line.find("NEF", at + 1)) {
    line.replace(at, 3, "'" + program_folder() + "/nef'");
  }
  const int status = std::system(("cd '" + here.path().string() + "' && " + line).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Two cubes that overlap, as quads.
constexpr const char* kTwoCubes =
    "0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n1 1 1\n3 1 1\n3 3 1\n1 3 1\n1 1 3\n3 1 3\n3 3 3\n1 3 3\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
    "4 11 10 9 8\n4 12 13 14 15\n4 8 9 13 12\n4 9 10 14 13\n4 10 11 15 14\n4 11 8 12 15\n";

}  // namespace

TEST_CASE("section writes drawings and sections in space") {
  const Workplace here;
  REQUIRE(here.nef("eval 'box(0,0,0,4,4,4) - box(1,1,-1,2,2,5)' -o a.nef").code == 0);
  const Outcome outcome = here.nef("section a.nef --plane 0,0,1,-1 -o a.svg --json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.json()["polygons"] == 1);
  CHECK(outcome.json()["area"] == 15.0);
  const std::string svg = here.read("a.svg");
  CHECK(svg.find("<svg") == 0);
  CHECK(std::count(svg.begin(), svg.end(), 'Z') == 2);  // a ring and its hole
  CHECK(svg.find("width=\"4.16mm\" height=\"4.16mm\"") != std::string::npos);
  CHECK(svg.find("viewBox=\"-0.08 -4.08 4.16 4.16\"") != std::string::npos);
  REQUIRE(here.nef("section a.nef --plane 0,0,1,-1 -o a.dxf").code == 0);
  const std::string dxf = here.read("a.dxf");
  CHECK(dxf.find("0\nSECTION\n2\nENTITIES\n") == 0);
  CHECK(dxf.rfind("0\nEOF\n") == dxf.size() - 6);
  REQUIRE(here.nef("section a.nef --plane 0,0,1,-1 -o s.nef").code == 0);
  CHECK(here.nef("eval 'file(\"a.nef\") * polygon(-9,-9,1, 9,-9,1, 9,9,1, -9,9,1)' -o t.nef").code == 0);
  CHECK(here.nef("equal s.nef t.nef").code == 0);
  REQUIRE(here.nef("section a.nef --plane 0,0,1,-1 -o s.off").code == 0);
  CHECK(here.nef("eval 'file(\"s.off\")' --as-surface -o u.nef").code == 0);
  CHECK(here.nef("info u.nef --json").json()["result"]["area"] == 15.0);
  check_refused(here.nef("section a.nef --plane 0,0,0,1 -o a.svg"), "normal");
  check_refused(here.nef("section a.nef --plane 0,0,1 -o a.svg"), "four numbers");
}

TEST_CASE("repair records what became of each face, as groups and as numbers") {
  const Workplace here;
  here.write("two.off", std::string("OFF\n16 12 0\n") + kTwoCubes);
  const Outcome outcome = here.nef("repair two.off -o two.nef --record record.obj --json");
  REQUIRE(outcome.code == 0);
  CHECK(outcome.json()["faces"]["cut"] == 6);
  CHECK(outcome.json()["faces"]["kept"] == 6);
  const std::string obj = here.read("record.obj");
  CHECK(obj.find("g kept\n") != std::string::npos);
  CHECK(obj.find("g cut\n") != std::string::npos);
  // A corner of each of six sides is inside of the other cube.
  CHECK(read_mesh(here.file("record.obj")).face_count() == 18);
  CHECK(read_mesh(here.file("record.obj#cut")).face_count() == 6);
  CHECK(read_mesh(here.file("record.obj#cut_off")).face_count() == 6);
  CHECK(outcome.json()["cut"]["kept"].get<double>() == Approx(0.75 * outcome.json()["cut"]["area"].get<double>()));
  REQUIRE(here.nef("repair two.off -o two.nef --record record.json").code == 0);
  const auto numbers = nlohmann::json::parse(here.read("record.json"));
  CHECK(numbers["faces"] == 12);
  CHECK(numbers["fates"]["cut"].size() == 6);
  for (const char* file : {"record.ply", "record.glb"}) {
    CHECK(here.nef(std::string("repair two.off -o two.nef --record ") + file).code == 0);
    CHECK(std::filesystem::exists(here.file(file)));
  }
  check_refused(here.nef("repair two.off -o two.nef --record record.stl"), "--record");
}

TEST_CASE("repair says what became of the named parts of a file") {
  const Workplace here;
  std::string text;
  std::size_t first = 1;
  const std::array<std::array<int, 2>, 3> cubes{{{0, 4}, {1, 2}, {3, 6}}};
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const Mesh mesh = read_off(cube_off(cubes[i][0], cubes[i][1]), "cube.off");
    text += "o " + std::string(1, static_cast<char>('a' + i)) + "\n";
    text += obj_lines(mesh, first);
    first += mesh.vertices.size();
  }
  here.write("three.obj", text);
  const Outcome outcome = here.nef("repair three.obj -o all.nef --record record.json --json");
  REQUIRE(outcome.code == 0);
  CHECK(outcome.json()["parts"]["a"]["cut"] == 3);
  CHECK(outcome.json()["parts"]["a"]["kept"] == 3);
  CHECK(outcome.json()["parts"]["b"]["inside"] == 6);
  CHECK(outcome.json()["done"].back() == "no face remains of the part 'b': it lies inside");
  CHECK(nlohmann::json::parse(here.read("record.json"))["parts"]["b"] == nlohmann::json{6, 7, 8, 9, 10, 11});
  // Without a record nothing is looked up, and one part is a mesh without parts.
  CHECK(here.nef("repair three.obj -o all.nef --json").json()["parts"].is_null());
  CHECK(here.nef("repair three.obj#c -o c.nef --record c.json --json").json()["parts"].is_null());
}

TEST_CASE("split writes the largest part, or those above a volume") {
  const Workplace here;
  REQUIRE(here.nef("eval 'box(0,0,0, 1,1,1) + box(2,0,0, 4,1,1) + box(5,0,0, 5.5,1,1)' -o three.nef").code == 0);
  const Outcome largest = here.nef("split three.nef --largest -o one.off --json");
  REQUIRE(largest.code == 0);
  CHECK(largest.json()["files"] == nlohmann::json::array({"one.off"}));
  CHECK(equal(read_polyhedron(here.file("one.off")), make_box({2, 0, 0}, {4, 1, 1})));
  const Outcome above = here.nef("split three.nef --above 1/2 -o some");
  CHECK(above.code == 0);
  CHECK(above.err.find("1 of 3 parts is left out") != std::string::npos);
  CHECK(std::filesystem::exists(here.file("some/1.off")));
  CHECK_FALSE(std::filesystem::exists(here.file("some/2.off")));
  check_refused(here.nef("split three.nef --largest --above 9 -o none.off -q"), "no part");
  // Into one file, if that is what -o names.
  REQUIRE(here.nef("split three.nef --above 1/2 -o two.off").code == 0);
  CHECK(equal(read_polyhedron(here.file("two.off")),
              unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({2, 0, 0}, {4, 1, 1}))));
  check_refused(here.nef("split three.nef --above 9 -o none.off -q"), "no part");
  CHECK_FALSE(std::filesystem::exists(here.file("none.off")));
}

TEST_CASE("parts of a file are chosen by name, and are operands of a union with origins") {
  const Workplace here;
  REQUIRE(here.nef("eval 'box(0,0,0, 2,2,2)' -o a.off").code == 0);
  REQUIRE(here.nef("eval 'box(1,1,1, 3,3,3)' -o b.off").code == 0);
  // Two groups of vertices of their own.
  std::string text;
  std::size_t first = 1;
  for (const char* name : {"a", "b"}) {
    const Mesh mesh = read_mesh(here.file(std::string(name) + ".off"));
    text += std::string("g ") + name + "\n";
    text += obj_lines(mesh, first);
    first += mesh.vertices.size();
  }
  here.write("two.obj", text);
  CHECK(here.nef("equal two.obj#b b.off").code == 0);
  check_refused(here.nef("info two.obj#c"), "there is no part 'c'; its parts are 'a', 'b'");
  const Outcome united = here.nef("union two.obj --origins -o both.obj --json");
  REQUIRE(united.code == 0);
  CHECK(united.json()["result"]["volume"] == "15");
  // Each cube keeps three whole sides and three that lack a corner.
  CHECK(united.json()["origins"].size() == 2);
  CHECK(united.json()["origins"].contains("two.obj#a"));
  // What was written has the same parts again, which are no solids.
  check_refused(here.nef("info both.obj#two.obj_a"), "open there");
  CHECK(here.nef("union two.obj -o same.nef").code == 0);
  CHECK(here.nef("equal same.nef both.obj").code == 0);
  // Parts that others cover have no faces.
  REQUIRE(here.nef("eval 'box(-1,-1,-1, 9,9,9)' -o cover.off").code == 0);
  const Outcome covered = here.nef("union two.obj cover.off --origins -o covered.obj --json");
  CHECK(covered.json()["origins"] == nlohmann::json{{"two.obj#a", 0}, {"two.obj#b", 0}, {"cover.off", 6}});
  // Of other operations the operands are files.
  REQUIRE(here.nef("intersection two.obj b.off --origins -o common.obj").code == 0);
  CHECK(here.nef("equal common.obj b.off").code == 0);
}

TEST_CASE("split writes a file for each part") {
  const Workplace here;
  REQUIRE(here.nef("eval 'box(0,0,0,1,1,1) + box(1,1,0,2,2,1) + box(5,0,0,6,1,1)' -o a.nef").code == 0);
  CHECK(here.nef("split a.nef -o parts").code == 0);
  CHECK(here.nef("check parts/0.off").code == 0);
  CHECK(here.nef("check parts/1.off").code == 0);
  CHECK_FALSE(std::filesystem::exists(here / "parts/2.off"));
  const Outcome volumes = here.nef("split a.nef -o cubes --volumes --format stl --json");
  CAPTURE(volumes.err);
  REQUIRE(volumes.json()["files"].size() == 3);
  const nlohmann::json files = volumes.json()["files"];  // a range over a part of a temporary would outlive it
  for (const auto& file : files) {
    CHECK(here.nef("info " + file.get<std::string>() + " --json").json()["result"]["volume"] == "1");
  }
}

TEST_CASE("distance tells contact, the exact square, and nearest points") {
  const Workplace here;
  here.write("a.off", cube_off(0, 1));
  here.write("b.off", cube_off(2, 3));
  here.write("c.off", cube_off(1, 3));
  const auto apart = here.nef("distance a.off b.off --json").json();
  CHECK(apart["contact"] == "disjoint");
  CHECK(apart["squared"] == "3");
  CHECK(apart["on_a"] == nlohmann::json::array({"1", "1", "1"}));
  CHECK(apart["on_b"] == nlohmann::json::array({"2", "2", "2"}));
  CHECK(here.nef("distance a.off c.off").out.find("touching") == 0);
  CHECK(here.nef("distance b.off c.off").out.find("overlapping") == 0);
}

TEST_CASE("repair says what it did, and whether that was enough") {
  const Workplace here;
  std::string turned = cube_off(0, 2);
  turned.replace(turned.find("4 0 2 3 1"), 9, "4 1 3 2 0");
  here.write("turned.off", turned);
  CHECK(here.nef("check turned.off").code == 1);
  const Outcome outcome = here.nef("repair turned.off -o b.off");
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("1 face flipped") == 0);
  CHECK(here.nef("check b.off").code == 0);
  std::string open = cube_off(0, 2);
  open.replace(open.find("8 6 0"), 5, "8 5 0");
  open.erase(open.find("4 0 2 3 1"), 10);
  here.write("open.off", open);
  const Outcome hopeless = here.nef("repair open.off -o c.off");
  CHECK(hopeless.code == 1);
  CHECK(hopeless.out.find("no file was written") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(here.file("c.off")));
  const Outcome lenient = here.nef("repair open.off -o c.off --lenient -q");
  CHECK(lenient.code == 1);
  CHECK(lenient.err.find("nef: warning: c.off: ") == 0);
  CHECK(read_mesh(here.file("c.off")).face_count() == 5);
  CHECK(here.nef("repair open.off -o c.off --fill-holes").code == 0);
  CHECK(here.nef("info c.off --json").json()["result"]["volume"] == "8");
  // A side is a sixth of the area.
  const Outcome large = here.nef("repair open.off -o d.off --close");
  CHECK(large.code == 1);
  CHECK(large.out.find("lids for its hole are more than 10 % of the area, --close=17 accepts them") !=
        std::string::npos);
  const Outcome closed = here.nef("repair open.off -o d.nef --close=17 --json");
  CHECK(closed.code == 0);
  CHECK(closed.json()["holes"]["count"] == 1);
  CHECK(closed.json()["holes"]["flat"] == 1);
  CHECK(closed.json()["holes"]["closed"] == true);
  CHECK(closed.json()["crossings"].is_null());
  CHECK(here.nef("equal c.off d.nef").code == 0);
  CHECK(here.nef("repair open.off -o e.nef").code == 1);
  CHECK_FALSE(std::filesystem::exists(here / "e.nef"));
  check_refused(here.nef("repair open.off -o e.off --close=200"), "--close");
}

TEST_CASE("every command closes holes when asked, and notes it") {
  const Workplace here;
  std::string open = cube_off(0, 2);
  open.replace(open.rfind("4 "), std::string::npos, "");
  open.replace(open.find("8 6 "), 4, "8 5 ");
  here.write("open.off", open);
  check_refused(here.nef("info open.off"), "--close (close=10 in Python) closes holes by a guess");
  check_refused(here.nef("info open.off --close"), "--close=17 accepts them");
  const Outcome closed = here.nef("union open.off open.off --close=17 -o two.nef --json");
  REQUIRE(closed.code == 0);
  CHECK(closed.json()["result"]["volume"] == "8");
  CHECK(here.nef("info open.off --close=20").err.find("a guess") != std::string::npos);
}

TEST_CASE("repair resolves faces that cross by a rule, and reports what it counted") {
  const Workplace here;
  here.write(
      "two.off",
      "OFF\n8 8 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 1 -1\n5 1 -1\n1 5 -1\n1 1 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
      "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n");
  CHECK(here.nef("repair two.off -o refused.off --crossings refuse").code == 1);
  const Outcome outcome = here.nef("repair two.off -o two.nef --json");
  REQUIRE(outcome.code == 0);
  test::check_report_shape(outcome.json(), "repair");
  // Corners of edge 4, of which the second is shifted by 1, 1, -1: they have one of edge 2 in common.
  const nlohmann::json crossings = outcome.json()["crossings"];
  CHECK(crossings["rule"] == "union");
  CHECK(crossings["pairs"] == 4);
  REQUIRE(crossings["volumes"].size() == 2);
  CHECK(crossings["volumes"][1]["winding_number"] == 2);
  CHECK(crossings["volumes"][1]["parts"] == 1);
  CHECK(crossings["volumes"][1]["volume"].get<double>() == Approx(4.0 / 3));
  CHECK(here.nef("info two.nef --json").json()["result"]["volume"] == "20");  // 2 * 64 / 6 - 8 / 6
  REQUIRE(here.nef("repair two.off -o odd.off --crossings odd").code == 0);
  CHECK(here.nef("info odd.off --json").json()["result"]["volume"] == "56/3");
}

TEST_CASE("drawings and STL files of nothing are such that other programs read them") {
  const Workplace here;
  REQUIRE(here.nef("eval nothing -o none.nef").code == 0);
  const Outcome none = here.nef("section none.nef --plane 0,0,1,0 -o none.svg");
  CHECK(none.code == 0);
  CHECK(none.err.find("note: the plane does not meet the set") != std::string::npos);
  CHECK(here.nef("repair none.nef -o none.off").err.find("needs no repair") != std::string::npos);
  const std::string svg = here.read("none.svg");
  const std::string box = "viewBox=\"";
  std::istringstream numbers(svg.substr(svg.find(box) + box.size()));
  double left = 0;
  double top = 0;
  float width = 0;  // as some readers have it
  float height = 0;
  numbers >> left >> top >> width >> height;
  CHECK(width > 0);
  CHECK(height > 0);
  CHECK(here.nef("convert none.nef -o none.stl").code == 0);
  // The binary form begins with 80 bytes and a number of four.
  CHECK(here.read("none.stl").size() >= 84);
  CHECK(here.nef("info none.stl").out.find("vertices: 0") != std::string::npos);
}

TEST_CASE("offsets of all files that are written are in the report, and formats without offsets are refused") {
  const Workplace here;
  const std::string far = "\"box(1000,0,0, 1001,1,1) + box(0,1000,0, 1,1002,1)\"";
  CHECK(here.nef("eval " + far + " -o two.nef").code == 0);
  const Outcome split = here.nef("split two.nef -o parts --recenter --json");
  CHECK(split.code == 0);
  const auto offsets = split.json()["offsets"];
  REQUIRE(offsets.size() == 2);
  // What is read, moved by the offset, is the set: by volumes of what both have.
  Polyhedron whole;
  for (const auto& [path, offset] : offsets.items()) {
    const Polyhedron part = read_polyhedron(here.file(path));
    const std::array<Rational3, 2> box = *bounding_box(part);
    for (std::size_t i = 0; i < 3; ++i) CHECK(abs(box[0][i]) <= 2);
    whole = unite(whole, transform(part, AffineMap::translate({Rational(offset[0].get<std::string>()),
                                                               Rational(offset[1].get<std::string>()),
                                                               Rational(offset[2].get<std::string>())})));
  }
  CHECK(equal(whole, read_polyhedron(here.file("two.nef"))));
  for (const char* option : {"--recenter", "--manifold"}) {
    for (const char* file : {"x.nef", "x.nef3", "x.tiles"}) {
      const Outcome refused = here.nef(std::string("convert two.nef -o ") + file + " " + option);
      CHECK(refused.code == 2);
      CHECK(refused.err.find(option) != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(here.file(file)));
    }
  }
}

TEST_CASE("subdivided meshes are files, and what cannot be subdivided is one line") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const Outcome fine = here.nef("subdivide a.off --times 2 -o fine.ply --json");
  CHECK(fine.code == 0);
  test::check_report_shape(fine.json(), "subdivide");
  CHECK(fine.json()["triangles"] == 12 * 16);
  CHECK(here.nef("equal a.off fine.ply").code == 0);
  REQUIRE(here.nef("subdivide fine.ply --scheme loop -o round.off").code == 0);
  CHECK(here.nef("check round.off").code == 0);
  CHECK(here.nef("difference round.off a.off --json").json()["result"]["volume"] == "0");  // smoothed, it shrinks
  REQUIRE(here.nef("eval 'box(0,0,0,1,1,1) + box(1,1,0,2,2,1)' -o pinched.nef").code == 0);
  check_refused(here.nef("subdivide pinched.nef --scheme loop -o b.off"), "one sheet");
  check_refused(here.nef("subdivide a.off --times 0 -o b.off"), "--times");
  REQUIRE(here.nef("eval 'point(0,0,0)' -o point.nef").code == 0);
  check_refused(here.nef("subdivide point.nef -o b.off"), "no bounded solid part");
}

TEST_CASE("a dash is standard input and output") {
  const Workplace here;
  CHECK(shell(here, "NEF eval 'box(0,0,0,1,1,2)' -o - | NEF info - --json > info.json") == 0);
  CHECK(nlohmann::json::parse(here.read("info.json"))["result"]["volume"] == "2");
  CHECK(shell(here, "NEF eval 'box(0,0,0,1,1,2)' -o - --format off > a.off") == 0);
  CHECK(here.read("a.off").find("OFF\n8 6 0\n") == 0);
  CHECK(shell(here, "NEF convert - -o b.stl < a.off") == 0);
  CHECK(here.nef("equal a.off b.stl").code == 0);
  check_refused(here.nef("eval 'box(0,0,0,1,1,2)' -o - --json"), "standard output");
}

}  // namespace nef::test
