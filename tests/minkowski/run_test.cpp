// SPDX-License-Identifier: Apache-2.0
//
// The program as a user runs it.
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/tiles/storage/tile_folder.h"
#include "nef/tiles/tiled_polyhedron.h"
#include "tests/support/literals.h"
#include "tests/support/paths.h"
#include "tests/support/report_shape.h"
#include "tests/support/temporary_folder.h"

namespace {

using nef::test::set;
using nlohmann::json;

struct Outcome {
  int code = -1;
  std::string out, err;
};

// A directory of its own, removed at the end.
class Place : public nef::test::TemporaryFolder {
 public:
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path() / name).string(); }

  void write(const std::string& name, const std::string& literal) const {
    nef::write_polyhedron(path() / name, set(literal));
  }

  [[nodiscard]] std::string read(const std::string& name) const { return nef::test::slurp(file(name)); }

  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + path().string() + "' && '" + program_folder() + "/minkowski' " + arguments +
                                " > stdout.txt 2> stderr.txt < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
  }
};

const char* const kL = "box(0,0,0,3,1,1) + box(0,0,0,1,3,1)";

TEST_CASE("command: a sum, and what its report says") {
  const Place place;
  place.write("a.nef", kL);
  place.write("b.nef", "box(0,0,0,1,1,1)");
  const Outcome outcome = place.run("a.nef b.nef -o sum.nef --report report.json --union queue");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out == "12 vertices, 18 edges, 8 facets, 2 volumes, 2 shells\n");
  const nef::Polyhedron expected = set("box(0,0,0,4,2,2) + box(0,0,0,2,4,2)");
  CHECK(nef::equal(nef::read_polyhedron(place / "sum.nef"), expected));
  const json report = json::parse(place.read("report.json"));
  CHECK(report["cells"] == json({2, 1}));
  CHECK(report["pairs"] == 2);
  CHECK(report["union"] == "queue");
  CHECK(report["result"]["volume"].is_null());
  CHECK(report["result"]["volume_double"].get<double>() ==
        Approx(24).epsilon(0).margin(report["result"]["volume_error"]));
  CHECK(report["result"]["volume_error"].get<double>() < 1e-9);
  CHECK(report["result"]["closed"] == true);
  CHECK(report["phases"]["op_s"].get<double>() > 0);
  CHECK(report["predicates_by_phase"].contains("union"));
  nef::test::check_report_shape(report, "sum");
  const Outcome exact = place.run("a.nef b.nef -o sum.nef --json --exact-volume");
  CHECK(json::parse(exact.out)["result"]["volume"] == "24");
}

TEST_CASE("command: folders of tiles are operands and results, as of nef") {
  const Place place;
  place.write("a.nef", kL);
  place.write("b.nef", "box(0,0,0,1,1,1)");
  nef::write_tiles(place / "a.tiles", nef::TiledPolyhedron(set(kL), {.limit = 32}));
  REQUIRE(place.run("a.nef b.nef -o sum.nef").code == 0);
  REQUIRE(place.run("a.tiles b.nef -o of_tiles.nef").code == 0);
  CHECK(nef::equal(nef::read_polyhedron(place / "of_tiles.nef"), nef::read_polyhedron(place / "sum.nef")));
  REQUIRE(place.run("--configuration-space --robot b.nef --obstacles a.tiles b.nef -o free.nef").code == 0);
  REQUIRE(place.run("--configuration-space --robot b.nef --obstacles a.nef b.nef -o same.nef").code == 0);
  CHECK(nef::equal(nef::read_polyhedron(place / "free.nef"), nef::read_polyhedron(place / "same.nef")));
  REQUIRE(place.run("a.nef b.nef -o sum.tiles").code == 0);
  CHECK(nef::equal(nef::read_file_or_tiles(place / "sum.tiles", {}), set("box(0,0,0,4,2,2) + box(0,0,0,2,4,2)")));
  const Outcome refused = place.run("a.nef b.nef -o sum.tiles --recenter");
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Catch::Contains("--recenter applies to mesh files"));
}

TEST_CASE("command: with --memory sums are made region by region, and are the same") {
  const Place place;
  place.write("a.nef", "(box(0,0,0,8,8,8) - interior(box(2,2,-1,5,5,9))) + box(6,6,7,7,7,9)");
  place.write("b.nef", "box(0,0,0,1,1,1)");
  for (const std::string& task :
       std::vector<std::string>{"a.nef b.nef", "a.nef b.nef --erode", "a.nef b.nef --open", "a.nef b.nef --close",
                                "a.nef --offset 1/4,2", "a.nef --open-a --offset=-1/4,2 --inner"}) {
    CAPTURE(task);
    REQUIRE(place.run(task + " -o whole.nef").code == 0);
    const Outcome outcome = place.run(task + " --memory 1M -o by_regions.nef --report report.json");
    CHECK(outcome.err.empty());
    REQUIRE(outcome.code == 0);
    CHECK(nef::equal(nef::read_polyhedron(place / "by_regions.nef"), nef::read_polyhedron(place / "whole.nef")));
    const json report = json::parse(place.read("report.json"));
    CHECK_THAT(report["strategies"][0]["why"].get<std::string>(), Catch::Contains(" regions"));
    CHECK(report["phases"]["op_s"].get<double>() > 0);
    REQUIRE(place.run(task + " --memory 1M -o by_regions.tiles --report report.json").code == 0);
    CHECK(json::parse(place.read("report.json"))["result"]["tiles"].get<int>() > 0);
    CHECK(
        nef::equal(nef::read_file_or_tiles(place / "by_regions.tiles", {}), nef::read_polyhedron(place / "whole.nef")));
  }
  CHECK_THAT(place.run("a.nef --hull --memory 1G -o c.nef").err, Catch::Contains("--memory goes with sums"));
  CHECK_THAT(place.run("a.nef b.nef --memory lots -o c.nef").err, Catch::Contains("--memory takes a size"));
  CHECK_THAT(place.run("a.nef b.nef --memory 1G -o c.nef --preview p").err, Catch::Contains("exclude each other"));
}

TEST_CASE("command: an offset is simplified, and its report says within which bounds") {
  const Place place;
  place.write("a.nef", kL);
  const Outcome outcome = place.run("a.nef --offset 1/4,4 --decimate 120 --digits 3 -o b.off --report report.json");
  CHECK(outcome.err.empty());
  REQUIRE(outcome.code == 0);
  const json report = json::parse(place.read("report.json"));
  const nef::Rational error(report["offset"]["error"].get<std::string>());
  CHECK(error > 0);
  CHECK(error < nef::Rational(1, 4));
  const nef::Mesh mesh = nef::read_mesh(place / "b.off");
  CHECK(mesh.face_count() <= 120);
  REQUIRE(place.run("a.nef --offset 1/4,4 -o c.nef").code == 0);
  const nef::Polyhedron simplified = nef::read_polyhedron(place / "b.off");
  CHECK(nef::subtract(nef::read_polyhedron(place / "c.nef"), simplified).is_empty());
  const nef::Rational reach = error + nef::Rational(1, 4);
  REQUIRE(place.run("a.nef --offset " + reach.get_str() + ",4 -o d.nef").code == 0);
  CHECK(nef::subtract(simplified, nef::read_polyhedron(place / "d.nef")).is_empty());
  CHECK_THAT(place.run("a.nef a.nef --digits 3 -o d.nef").err, Catch::Contains("go with --offset"));
  CHECK_THAT(place.run("a.nef --offset 1 --digits 3 --memory 1G -o d.nef").err, Catch::Contains("exclude each other"));
}

TEST_CASE("command: many notes are a few lines, and all of them in the report") {
  const Place place;
  // Eighty square pyramids apart from each other, with a corner of each base lifted, so that the base is bent.
  std::ostringstream vertices;
  std::ostringstream faces;
  for (int i = 0; i < 80; ++i) {
    const int x = 3 * i;
    vertices << x << " 0 0\n" << x + 1 << " 0 0\n" << x + 1 << " 1 1/8\n" << x << " 1 0\n" << x << " 0 2\n";
    const int v = 5 * i;
    faces << "4 " << v << ' ' << v + 3 << ' ' << v + 2 << ' ' << v + 1 << '\n';
    for (int k = 0; k < 4; ++k) faces << "3 " << v + k << ' ' << v + (k + 1) % 4 << ' ' << v + 4 << '\n';
  }
  std::ofstream(place / "bent.off") << "OFF\n400 400 0\n" << vertices.str() << faces.str();
  const Outcome outcome = place.run("--hull bent.off -o hull.nef --report report.json");
  CHECK(outcome.code == 0);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 6);
  CHECK_THAT(outcome.err, Catch::Contains("note: and 75 more"));
  CHECK(json::parse(place.read("report.json"))["messages"].size() == 80);
  CHECK(place.run("--hull bent.off -o hull.nef -q").err.empty());
}

TEST_CASE("command: the report says which strategy was taken, and why") {
  const Place place;
  place.write("a.nef", kL);
  place.write("cube.nef", "box(0,0,0,1,1,1)");
  place.write("thin.nef", "segment(0,0,0,1,1,1)");
  place.write("hole.nef", "!(box(0,0,0,3,1,1) + box(0,0,0,1,3,1))");
  place.write("half.nef", "halfspace(1,0,0,0)");
  const auto strategies = [&](const std::string& arguments) {
    const Outcome outcome = place.run(arguments + " -o out.nef --json");
    CAPTURE(arguments, outcome.err);
    REQUIRE(outcome.code == 0);
    json found = json::parse(outcome.out)["strategies"];
    for (const json& strategy : found) CHECK_FALSE(strategy["why"].get<std::string>().empty());
    return found;
  };
  CHECK(strategies("a.nef a.nef")[0]["chosen"] == "convolution");
  CHECK(strategies("cube.nef cube.nef")[0]["why"] == "both operands are convex");
  CHECK(strategies("a.nef thin.nef")[0]["why"] == "both operands are closed, and one is solid");
  CHECK(strategies("thin.nef thin.nef")[0]["why"].get<std::string>().find("A has parts that are not solid") == 0);
  CHECK(strategies("hole.nef cube.nef")[0]["why"].get<std::string>().find("bounded complement") != std::string::npos);
  CHECK(strategies("half.nef cube.nef")[0]["chosen"] == "planes");
  CHECK(strategies("a.nef cube.nef --open").size() == 2);
  const json asked = strategies("a.nef a.nef --union queue");
  CHECK(asked[0]["chosen"] == "queue");
  CHECK(asked[0]["why"].get<std::string>().find("requested") == 0);
}

TEST_CASE("command: a B that is convex but for rounding is noticed, whatever the strategy") {
  const Place place;
  place.write("a.nef", kL);
  // A cube whose top is split along a diagonal that sags by 10^-12.
  std::ofstream(place / "b.off") << "OFF\n8 7 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1.000000000001\n1 1 1\n"
                                    "0 1 1.000000000001\n4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
                                    "3 4 5 6\n3 4 6 7\n";
  for (const char* strategy : {"auto", "queue", "convolution"}) {
    CAPTURE(strategy);
    const Outcome outcome = place.run("a.nef b.off -o sum.nef --union " + std::string(strategy));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("B is convex but for 3e-13 of its volume; --hull-b uses its convex hull") !=
          std::string::npos);
  }
  const Outcome hull = place.run("a.nef b.off -o hull.nef --hull-b");
  CHECK(hull.err.empty());
  CHECK(nef::subtract(nef::read_polyhedron(place / "sum.nef"), nef::read_polyhedron(place / "hull.nef")).is_empty());
}

TEST_CASE("command: open operands, a mirrored one, offsets by a ball and a box") {
  const Place place;
  place.write("a.nef", kL);
  place.write("b.nef", "box(1,1,1,2,3,4)");
  const auto result = [&](const std::string& arguments) {
    const Outcome outcome = place.run(arguments + " -o out.nef -q");
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    return nef::read_polyhedron(place / "out.nef");
  };
  const nef::Polyhedron open = set("interior(box(1,1,1,5,4,5) + box(1,1,1,3,6,5))");
  CHECK(nef::equal(result("a.nef b.nef --open-a"), open));
  CHECK(nef::equal(result("a.nef b.nef --open-b"), open));
  CHECK(nef::equal(result("a.nef b.nef --negate-b"), set("box(-2,-3,-4,2,0,0) + box(-2,-3,-4,0,2,0)")));
  CHECK(
      nef::equal(result("a.nef --box-tool 1,1/2,0"), set("box(-1/2,-1/4,0,7/2,5/4,1) + box(-1/2,-1/4,0,3/2,13/4,1)")));
  CHECK(nef::equal(result("b.nef --ball 1,1"),
                   set("hull(0,1,1, 0,3,1, 0,1,4, 0,3,4, 3,1,1, 3,3,1, 3,1,4, 3,3,4, 1,0,1, 2,0,1, 1,0,4, 2,0,4,"
                       "1,4,1, 2,4,1, 1,4,4, 2,4,4, 1,1,0, 2,1,0, 1,3,0, 2,3,0, 1,1,5, 2,1,5, 1,3,5, 2,3,5)")));
}

TEST_CASE("command: cells of a decomposition to a coloured file and into a directory") {
  const Place place;
  place.write("a.nef", std::string(kL) + " + segment(3,1,1, 5,5,5)");
  const Outcome in_off = place.run("--decompose a.nef -o cells.off");
  CHECK(in_off.out == "3 cells\n");
  CHECK(in_off.err.find("1 of the cells are segments or points, which OFF cannot store") != std::string::npos);
  // Two hulls of 8 vertices and 6 faces.
  CHECK(place.read("cells.off").rfind("OFF\n16 12 0\n", 0) == 0);
  CHECK(nef::read_mesh(place / "cells.off").face_count() == 12);
  CHECK(place.run("--decompose a.nef -o cells.glb -q").code == 0);
  CHECK(nef::read_mesh(place / "cells.glb").face_count() == 24);
  CHECK(nef::read_mesh(place / "cells.glb#cell_2").face_count() == 12);
  // A cell's place in the file and the offset are its place in space.
  place.write("far.nef", "box(100,0,0,103,1,1) + box(100,0,0,101,3,1)");
  CHECK(place.run("--decompose far.nef -o there.off --exact").code == 0);
  const Outcome moved = place.run("--decompose far.nef -o moved.off --recenter --exact --json");
  CHECK(moved.code == 0);
  const json offset = json::parse(moved.out)["offsets"]["moved.off"];
  const nef::Mesh there = nef::read_mesh(place / "there.off");
  const nef::Mesh here = nef::read_mesh(place / "moved.off");
  CHECK(offset[0] != "0");
  REQUIRE(here.vertices.size() == there.vertices.size());
  for (std::size_t v = 0; v < here.vertices.size(); ++v) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(here.vertices[v][i] + nef::Rational(offset[i].get<std::string>()) == there.vertices[v][i]);
    }
  }
  CHECK(place.run("--decompose a.nef -o moved --format nef --recenter").code == 2);
  // A plate that is thinner than the distance of doubles there.
  place.write("thin.nef", "box(0,0,0,1,1,1) + box(1000000,0,0,1000000000000000001/1000000000000,1,1)");
  const Outcome thin = place.run("--decompose thin.nef -o thin.off");
  CHECK(thin.code == 2);
  CHECK(thin.err.find("1 cell is no solid any more with rounded coordinates (cell 2: ") != std::string::npos);
  CHECK(thin.err.find("--exact") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(place / "thin.off"));
  CHECK(place.run("--decompose thin.nef -o thin.off --exact").code == 0);
  const Outcome lenient = place.run("--decompose thin.nef -o thin.off --lenient -q");
  CHECK(lenient.code == 0);
  CHECK(lenient.err.find("warning: thin.off: 1 cell is no solid") != std::string::npos);
  const Outcome ply = place.run("--decompose a.nef -o cells.ply");
  CHECK(ply.code == 0);
  CHECK(ply.err.find("1 of the cells are segments or points") != std::string::npos);
  CHECK(place.run("--decompose a.nef -o cells.obj --quiet").code == 0);
  CHECK(place.read("cells.obj").find("\nl 17 18\n") != std::string::npos);
  const nef::Mesh mesh = nef::read_mesh(place / "cells.ply");
  CHECK(mesh.vertices.size() == 16);
  CHECK(mesh.face_count() == 12);
  CHECK(place.read("cells.ply").find("property uchar red") != std::string::npos);
  CHECK(place.run("--decompose a.nef -o cells --format nef").code == 0);
  std::vector<nef::Polyhedron> cells;
  for (const char* name : {"cells/cell_0001.nef", "cells/cell_0002.nef", "cells/cell_0003.nef"}) {
    cells.push_back(nef::read_polyhedron(place / name));
  }
  CHECK(nef::equal(nef::unite_all(cells), nef::read_polyhedron(place / "a.nef")));

  // Again into the same directory: fewer cells would stand among the old ones.
  CHECK(place.run("--decompose a.nef -o cells --format nef").code == 0);
  place.write("b.nef", "box(0,0,0,1,1,1)");
  for (const char* format : {"nef", "off"}) {
    const Outcome refused = place.run(std::string("--decompose b.nef -o cells --format ") + format);
    CHECK(refused.code == 2);
    CHECK(refused.err.find("earlier run") != std::string::npos);
  }
}

TEST_CASE("command: free space with a tight passage") {
  const Place place;
  place.write("robot.nef", "box(0,0,0,1,1,1)");
  place.write("left.nef", "box(-20,-20,-20,-1,20,20)");
  place.write("right.nef", "box(0,-20,-20,20,20,20)");
  const Outcome outcome = place.run(
      "--configuration-space --robot robot.nef --obstacles left.nef right.nef --box -5,-5,-5,5,5,5 -o free.nef --json "
      "--exact-volume");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(json::parse(outcome.out)["result"]["volume"] == "0");
  CHECK(nef::equal(nef::read_polyhedron(place / "free.nef"), set("polygon(-1,-5,-5, -1,5,-5, -1,5,5, -1,-5,5)")));
}

TEST_CASE("command: what a milling tool leaves, and its regions as groups of a mesh") {
  const Place place;
  place.write("part.nef", "box(0,0,0,9,3,3) - interior(box(4,-1,1,9/2,9,9)) - interior(box(6,1,1,8,2,2))");
  const Outcome outcome =
      place.run("part.nef --box-tool 1,1,1 --millable --axes 3 -o shape.nef --labels left.obj --json --exact-volume");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json report = json::parse(outcome.out);
  REQUIRE(report["unreached"].size() == 2);
  CHECK(report["unreached"][0]["volume"] == "3");
  CHECK(report["unreached"][1]["volume"] == "2");
  CHECK(report["result"]["volume"] == "81");
  CHECK(report["faces"]["region1"] == 6);
  CHECK(report["faces"]["region2"] == 6);
  CHECK(place.read("left.obj").find("g region2\n") != std::string::npos);
}

TEST_CASE("command: what a tool can touch, as labels of the part's faces") {
  const Place place;
  // A box with a pocket that is too narrow for the tool: the upper rim is touched, the walls and the floor are not.
  place.write("part.nef", "box(0,0,0,8,8,4) - interior(box(3,3,1,4,4,5))");
  place.write("tool.nef", "box(-1,-1,0,1,1,3)");
  const Outcome outcome =
      place.run("tool.nef part.nef --reach -o positions.nef --labels labels.obj --preview pictures --json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json report = json::parse(outcome.out);
  CHECK(report["touched_area"].get<double>() == Approx(4 * 32 + 2 * 64 - 1));
  CHECK(report["untouched_area"].get<double>() == Approx(4 * 3 + 1));
  CHECK(report["faces"]["untouched"] == 5);
  CHECK(report["faces"]["touched"].get<int>() > 5);
  const std::string text = place.read("labels.obj");
  CHECK(text.find("g touched\n") != std::string::npos);
  CHECK(text.find("g untouched\n") != std::string::npos);
  const nef::Mesh mesh = nef::read_mesh(place / "labels.obj");
  CHECK(nef::equal(nef::from_mesh(mesh), nef::read_polyhedron(place / "part.nef")));
  CHECK(place.read("pictures/labels.png").rfind("\x89PNG", 0) == 0);
  // A wide pocket of which the tool touches the floor, but not where it is undercut: the floor is in both groups.
  place.write("part.nef", "box(0,0,0,8,8,4) - interior(box(2,2,1,5,5,5)) - interior(box(2,2,1,7,5,2))");
  const Outcome undercut = place.run("tool.nef part.nef --reach -o positions.nef --labels labels.ply --json");
  REQUIRE(undercut.code == 0);
  // The undercut's floor, ceiling, end and sides.
  CHECK(json::parse(undercut.out)["untouched_area"].get<double>() == Approx(6 + 6 + 3 + 2 * 2));
  CHECK(place.read("labels.ply").find("comment group 1 untouched") != std::string::npos);
  // Offsets stand beside each file; that of the task has a key of its own.
  const Outcome moved =
      place.run("tool.nef part.nef --reach -o positions.nef --labels labels.glb --recenter --manifold --json");
  REQUIRE(moved.code == 0);
  const json offsets = json::parse(moved.out)["offsets"];
  CHECK(offsets == json{{"labels.glb", {"8", "8", "0"}}});
  CHECK(nef::equal(nef::read_polyhedron(place / "labels.glb"), nef::read_polyhedron(place / "part.nef")));
  place.write("far.nef", "box(100,0,0,101,1,1)");
  const Outcome grown = place.run("far.nef --offset 1 --recenter -o grown.ply --json");
  REQUIRE(grown.code == 0);
  CHECK(json::parse(grown.out)["offset"]["radius"] == "1");
  CHECK(json::parse(grown.out)["offsets"].contains("grown.ply"));
  const Outcome refused = place.run("tool.nef part.nef --reach -o positions.nef --labels labels.nef");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("labels.nef") != std::string::npos);
}

TEST_CASE("command: operands with holes are closed when asked, crossing ones are united") {
  const Place place;
  place.write("box.nef", "box(0,0,0,2,2,2)");
  std::ofstream(place / "open.off") << "OFF\n8 5 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n"
                                       "4 3 2 1 0\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  for (const std::string task : {" --offset 1,2", " --ball 1,2", " --box-tool 1,1,1"}) {
    CAPTURE(task);
    REQUIRE(place.run("box.nef" + task + " -o wanted.nef").code == 0);
    const Outcome closed = place.run("open.off" + task + " --close-holes=20 -o closed.nef");
    REQUIRE(closed.code == 0);
    CHECK(closed.err.find("1 hole closed by lids of 17 % of the area") != std::string::npos);
    CHECK(nef::equal(nef::read_polyhedron(place / "closed.nef"), nef::read_polyhedron(place / "wanted.nef")));
    CHECK(place.run("open.off" + task + " -o open.nef").code == 2);
  }
}

TEST_CASE("command: bad usage and bad input are one line on stderr, code 2, and no file") {
  const Place place;
  place.write("a.nef", kL);
  place.write("half.nef", "halfspace(1,0,0,0) * halfspace(0,1,0,0)");
  std::ofstream(place / "bad.off") << "OFF\n1 1 0\n0 0 nan\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a.nef -o out.nef", "two operands"},
      {"a.nef a.nef", "name a file with -o"},
      {"a.nef missing.nef -o out.nef", "missing.nef"},
      {"a.nef bad.off -o out.nef", "bad.off"},
      {"--decompose half.nef -o out.off", "unbounded"},
      {"a.nef a.nef -o out.nef --union best", "best"},
      {"a.nef --ball 1 -o out.nef", "--ball"},
      {"a.nef --ball 1,2.5 -o out.nef", "--ball"},
      {"a.nef --ball -1,2 -o out.nef", "radius"},
      {"a.nef --box-tool 1,x,1 -o out.nef", "--box-tool"},
      {"a.nef --box-tool 1,1,1 --ball 1,1 -o out.nef", "one of them"},
      {"a.nef a.nef --robot a.nef -o out.nef", "--configuration-space"},
      {"--configuration-space --obstacles a.nef -o out.nef", "--robot"},
      {"--configuration-space --robot a.nef -o out.nef", "--obstacles"},
      {"--configuration-space --robot a.nef --obstacles a.nef --box 0,1,0,1,0,1 -o out.nef", "lower corner"},
      {"a.nef a.nef --format ply -o out.nef", "--format"},
      {"--decompose a.nef --ball 1,2 -o out.off", "--decompose"},
      {"--decompose a.nef -o out.txt", "off, obj, stl"},
      {"a.nef a.nef --erode --open -o out.nef", "two tasks"},
      {"a.nef a.nef --penetration -o out.nef", "takes no -o"},
      {"a.nef a.nef --offset 1 -o out.nef", "one operand"},
      {"a.nef --offset 1 --ball 1,1 -o out.nef", "--offset"},
      {"a.nef --offset x -o out.nef", "--offset"},
      {"a.nef --offset 1,65 -o out.nef", "1 to 64"},
      {"a.nef --inner --outer --ball 1,1 -o out.nef", "exclude"},
      {"a.nef a.nef --inner -o out.nef", "--inner"},
      {"a.nef a.nef --from 1,1,1 -o out.nef", "--reach"},
      {"a.nef a.nef --labels out.obj -o out.nef", "--reach"},
      {"a.nef a.nef --axes 3 -o out.nef", "--millable"},
      {"a.nef a.nef --millable --axes 5 -o out.nef", "--axes"},
      {"a.nef a.nef --millable --touched out.obj -o out.nef", "--reach"},
      {"a.nef a.nef --reach --from 1,1 -o out.nef", "--from"},
      {"a.nef a.nef --reach --from 1/4,1/4,1/4 -o out.nef", "overlaps"},
      {"a.nef a.nef -o out.xyz", "out.xyz"}};
  const std::size_t before = place.file_count();
  for (const auto& [arguments, words] : cases) {
    const Outcome outcome = place.run(arguments);
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
  }
  CHECK(place.file_count() == before + 2);  // stdout.txt and stderr.txt
}

TEST_CASE("command: an unbounded operand") {
  const Place place;
  place.write("half.nef", "halfspace(1,0,0,0) * halfspace(0,1,0,0)");
  CHECK(place.run("half.nef --box-tool 2,2,2 -o out.nef --quiet").code == 0);
  CHECK(nef::equal(nef::read_polyhedron(place / "out.nef"), set("halfspace(1,0,0,-1) * halfspace(0,1,0,-1)")));
}

TEST_CASE("command: pictures of operands, results and cells, the result does not depend on threads") {
  const Place place;
  place.write("a.nef", kL);
  CHECK(place.run("a.nef a.nef -o one.nef --preview pictures --threads 1").code == 0);
  CHECK(place.run("--decompose a.nef -o cells.off --preview pictures").code == 0);
  CHECK(place.run("--configuration-space --robot a.nef --obstacles a.nef -o free.nef --preview pictures").code == 0);
  for (const char* name : {"a", "b", "sum", "cells", "robot", "obstacles", "free_space"}) {
    CAPTURE(name);
    CHECK(place.read("pictures/" + std::string(name) + ".png").rfind("\x89PNG", 0) == 0);
  }
  CHECK(place.run("a.nef a.nef -o four.nef --threads 4").code == 0);
  CHECK(place.read("one.nef") == place.read("four.nef"));
  // Many flat cells, which are united one by one.
  place.write("b.nef", std::string(kL) +
                           " + segment(9,9,9, 12,9,9) - point(10,9,9) + point(20,20,20) +"
                           " polygon(0,0,-5, 4,0,-5, 4,4,-5, 0,4,-5) - segment(1,1,-5, 2,2,-5)");
  CHECK(place.run("b.nef b.nef -o one.nef --threads 1").code == 0);
  CHECK(place.run("b.nef b.nef -o four.nef --threads 4").code == 0);
  CHECK(place.read("one.nef") == place.read("four.nef"));
}

TEST_CASE("command: an interrupt stops at once and leaves a whole file or none") {
  const Place place;
  place.write("a.nef", kL);
  const std::string program = "'" + program_folder() + "/minkowski'";
  const std::size_t before = place.file_count() + 2;  // stdout.txt and stderr.txt
  // In the middle of work that takes long: nothing is written.
  const auto interrupted = [&](const std::string& seconds, const std::string& arguments) {
    const std::string command = "cd '" + (place / "") + "' && timeout --preserve-status -s INT " + seconds + " " +
                                program + " " + arguments + " > stdout.txt 2> stderr.txt < /dev/null";
    return std::system(command.c_str());
  };
  const std::string mushroom = source_folder() + "/data/minkowski/mushroom.off";
  CHECK(interrupted("0.2", mushroom + " " + mushroom + " --union queue -o out.nef") != 0);
  CHECK(place.file_count() == before);
  // At any moment of short work.
  for (int i = 1; i <= 15; ++i) {
    interrupted("0.0" + std::string(i < 10 ? "0" : "") + std::to_string(i), "a.nef --ball 1,6 -o out.nef");
    const bool whole = std::filesystem::exists(place / "out.nef");
    if (whole) CHECK_FALSE(nef::read_polyhedron(place / "out.nef").is_empty());
    CHECK(place.file_count() == before + (whole ? 1 : 0));
  }
}

// The indented lines of a section of a document.
std::vector<std::string> commands_in(const std::string& document, const std::string& section) {
  std::istringstream text(nef::test::slurp(document));
  std::vector<std::string> lines;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("## ", 0) == 0) inside = line == "## " + section;
    if (inside && line.rfind("    ", 0) == 0) lines.push_back(line.substr(4));
  }
  return lines;
}

TEST_CASE("command: the recipes of the documentation run, and do what they say") {
  const Place place;
  for (const std::string& line : commands_in(source_folder() + "/docs/minkowski.md", "Recipes")) {
    const std::string command = "cd '" + place.path().string() + "' && PATH='" + program_folder() + "':\"$PATH\" " +
                                line + " > stdout.txt 2> stderr.txt < /dev/null";
    CAPTURE(line);
    CHECK(std::system(command.c_str()) == 0);
    CHECK(place.read("stderr.txt").empty());
  }
  const auto result = [&](const std::string& name) { return nef::read_polyhedron(place / (name + ".nef")); };
  const nef::Polyhedron part = result("part");
  CHECK(nef::subtract(part, result("grown")).is_empty());
  CHECK(nef::subtract(result("shrunk"), nef::interior(part)).is_empty());
  CHECK(nef::equal(nef::unite(result("shell"), result("core")), part));
  CHECK(nef::equal(result("eroded"), set("box(0,0,0, 2,7,1) + box(4,0,0, 7,7,1) + box(0,0,0, 7,7,0)")));
  CHECK(nef::equal(result("opened"), set("box(0,0,0, 8,8,2) - interior(box(3,-1,1, 4,9,3))")));
  CHECK(nef::equal(result("closed"), set("box(0,0,0, 8,8,2) + box(8,2,0, 12,5/2,2)")));
  CHECK(nef::equal(result("also_eroded"), result("eroded")));
  CHECK(nef::equal(result("also_swept"), result("swept")));
  CHECK(nef::subtract(result("inner_grown"), result("grown")).is_empty());
  CHECK(nef::contains(result("swept"), {nef::Rational(7, 2), 2, 1}));
  CHECK(nef::contains(result("contact"), {3, 2, 1}));
  CHECK(nef::contains(result("positions"), {nef::Rational(7, 2), 2, 1}));
  CHECK(nef::subtract(part, result("hull")).is_empty());
}

}  // namespace
