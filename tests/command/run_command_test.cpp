// SPDX-License-Identifier: Apache-2.0
//
// The program as its users meet it: real files, exit codes, JSON.
#include "command/process.h"
#include "tests/support/report_shape.h"

namespace nef::test {
namespace {

using nlohmann::json;

void check_cube_info(const json& info, const std::string& volume, double area) {
  CHECK(info["vertices"] == 8);
  CHECK(info["edges"] == 12);
  CHECK(info["facets"] == 6);
  CHECK(info["volumes"] == 2);
  CHECK(info["shells"] == 2);
  CHECK(info["bounded"] == true);
  CHECK(info["closed"] == true);
  CHECK(info["open"] == false);
  CHECK(info["regular"] == true);
  CHECK(info["volume"] == volume);
  CHECK(info["area"].get<double>() == Approx(area));
  CHECK(info["euler_numbers"] == json::array({2, 2}));
}

}  // namespace

TEST_CASE("help and version everywhere") {
  const Workplace here;
  CHECK(here.nef("--version").code == 0);
  const std::string version = here.nef("--version").out;
  CHECK(version.rfind("nef ", 0) == 0);
  CHECK(version.find("\nlibraries: GMP ") != std::string::npos);
  CHECK(version.find(", oneTBB ") != std::string::npos);
  const Outcome help = here.nef("--help");
  CHECK(help.code == 0);
  CHECK(help.err.empty());
  for (const std::string command :
       {"union", "intersection", "difference", "symdiff", "complement", "interior", "closure", "boundary", "exterior",
        "regularize", "transform", "info", "check", "equal", "locate", "ray", "convert", "eval", "apply"}) {
    CHECK(help.out.find("  " + command) != std::string::npos);
    const Outcome own = here.nef(command + " --help");
    CHECK(own.code == 0);
    CHECK(own.out.find("--json") != std::string::npos);
  }
}

TEST_CASE("an output that cannot be written is refused before anything is read") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  for (const std::string command :
       {"convert missing.off", "union a.off missing.off", "section missing.off --plane 0,0,1,-1",
        "split missing.off --largest", "repair missing.off"}) {
    INFO(command);
    check_refused(here.nef(command + " -o b.step"), "b.step: unknown extension; use ");
    check_refused(here.nef(command + " -o folder/b.off"),
                  "folder/b.off: cannot be written (No such file or directory)");
    check_refused(here.nef(command + " -o b.off"), "missing.off: no such file");
  }
  CHECK(here.nef("convert a.off -o b.step --format stl").code == 0);
  CHECK(here.nef("convert a.off -o a.tiles").code == 0);
  CHECK(here.nef("section a.off --plane 0,0,1,-1 -o b.svg").code == 0);
}

TEST_CASE("usage errors are one line and exit code 2") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  check_refused(here.nef(""), "subcommand");
  check_refused(here.nef("frobnicate a.off"), "frobnicate");
  check_refused(here.nef("unoin a.off -o b.off"),
                "there is no subcommand 'unoin'; did you mean 'union'? (see nef --help)");
  check_refused(here.nef("rotate a.off -o b.off"), "there is no subcommand 'rotate'; did you mean 'transform'?");
  check_refused(here.nef("offset a.off -o b.off"), "'offset'; that is 'minkowski A --offset R -o B'");
  for (const std::string plane : {"z=2", "0,0,1"}) {
    check_refused(here.nef("section a.off --plane " + plane), "(z = 2 is 0,0,1,-2), instead of '" + plane + "'");
    check_refused(here.nef("picture a.off -o a.png --section " + plane), "--section: expected four numbers a,b,c,d");
  }
  check_refused(here.nef("section a.off --plane 0,0,1,-1 -o b.pdf"), "svg, dxf, nef,");
  check_refused(here.nef("info a.off --thraeds 2"),
                "no option '--thraeds'; did you mean '--threads'? (see nef info --help)");
  check_refused(here.nef("--threads 2 info a.off"),
                "there is no option '--threads' before the subcommand; write it behind 'info'");
  check_refused(here.nef("info a.off --threads x"), "--threads: expected a number from 0 to 4096, not 'x'");
  check_refused(here.nef("equal a.off"), "give at least 2 inputs, not 1");
  check_refused(here.nef("subdivide a.off -o b.off --scheme fast"), "--scheme: expected midpoint or loop, not 'fast'");
  check_refused(here.nef("subdivide a.off -o b.off --times"), "--times needs a value: UINT");
  check_refused(here.nef("complement a.off 1 2 -o b.off"),
                "unexpected argument '1'; several numbers are one word with commas");
  check_refused(here.nef("picture a.off -o b.png --size 480"),
                "--size: expected WIDTHxHEIGHT, as in 1200x900, instead of '480'");
  check_refused(here.nef("eval a.off -o b.off"), R"(a.off is a file: write 'file("a.off")')");
  check_refused(here.nef("eval model.scad -o b.off"), "openscad -o model.csg model.scad");
  check_refused(here.nef("intersection a.off"), "nef intersection --help");
  check_refused(here.nef("difference a.off"), "nef difference --help");
  check_refused(here.nef("convert a.off"), "--output");
  check_refused(here.nef("convert a.off b.off"),
                "--output is required; unexpected argument 'b.off'; an output file is named with -o");
  check_refused(here.nef("info a.off b.off"), "unexpected argument 'b.off' (see nef info --help)");
  check_refused(here.nef("info a.off --frob"), "--frob");
  check_refused(here.nef("section a.off"), "--plane A,B,C,D is required (see nef section --help)");
  check_refused(here.nef("section a.off --plane -o x.svg"),
                "--plane needs a value, and '-o' is an option (see nef section --help)");
  check_refused(here.nef("help section"), "'help' is an option, --help (see nef section --help)");
  check_refused(here.nef("help"), "'help' is an option, --help (see nef --help)");
  check_refused(here.nef("locate a.off 1,2"), "1,2");
  check_refused(here.nef("locate a.off 1,2,three"), "three");
  check_refused(here.nef("ray a.off 0,0,0 0,0,0"), "direction");
  check_refused(here.nef("transform a.off --rotate w,3 -o b.off"), "--rotate");
  check_refused(here.nef("transform a.off --rotate z -o b.off"), "AXIS,DEGREES");
  check_refused(here.nef("transform a.off --matrix 1,2,3 -o b.off"), "12 or 16");
  check_refused(here.nef("transform a.off --scale 0 -o b.off"), "determinant");
  check_refused(here.nef("convert a.off -o b.xyz"), "xyz");
  check_refused(here.nef("convert a.off -o ''"), "empty");
  check_refused(here.nef("convert a.off -o missing/b.off"), "missing");
  check_refused(here.nef("info a.off --json --repeat 2"), "--repeat");
  CHECK_FALSE(std::filesystem::exists(here / "b.off"));
}

TEST_CASE("Boolean operations on files, with the promised JSON") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  here.write("b.off", cube_off(1, 3));
  here.write("c.off", cube_off(2, 3));
  const Outcome meet = here.nef("intersection a.off b.off -o meet.off --json --repeat 3");
  REQUIRE(meet.code == 0);
  const json report = meet.json();
  for (const char* key : {"load_s", "op_s", "write_s"}) {
    CHECK(report["phases"][key].is_number());
    CHECK(report["phases"][key].get<double>() > 0);
  }
  nef::test::check_report_shape(report, "intersection");
  check_cube_info(report["result"], "1", 6);
  check_cube_info(here.nef("info meet.off --json").json()["result"], "1", 6);

  CHECK(here.nef("union a.off b.off --json").json()["result"]["volume"] == "15");
  CHECK(here.nef("difference a.off b.off --json").json()["result"]["volume"] == "7");
  CHECK(here.nef("symdiff a.off b.off --json").json()["result"]["volume"] == "14");
  // The cut out part leaves an open boundary, which no mesh has: it is in the report only.
  const Outcome cut = here.nef("difference a.off b.off -o cut.off --json");
  CHECK(cut.err.empty());
  CHECK(cut.json()["messages"].size() == 1);
  CHECK(here.nef("union a.off b.off c.off --json").json()["result"]["volume"] == "15");
  CHECK(here.nef("intersection a.off b.off c.off --json").json()["result"]["vertices"] == 1);
}

TEST_CASE("a Boolean tells with --origins from which operand each face comes") {
  const Workplace here;
  here.write("left box.off", cube_off(0, 2));
  here.write("b.off", cube_off(1, 3));
  const Outcome run = here.nef("difference 'left box.off' b.off --origins -o d.obj --json");
  CHECK(run.code == 0);
  CHECK(run.json()["origins"].size() == 2);
  CHECK(run.json()["origins"]["b.off"] == 3);
  CHECK(run.json()["result"]["volume"] == "7");
  CHECK(here.read("d.obj").find("g left_box.off\n") != std::string::npos);
  CHECK(here.nef("check d.obj").code == 0);
  const Outcome said = here.nef("symdiff b.off b.off --origins -o e.ply");
  CHECK(said.code == 0);
  CHECK(here.nef("union b.off ./b.off --origins -o u.ply").out.find("b.off+./b.off: 6 faces") != std::string::npos);
  CHECK(here.nef("union b.off b.off --origins -o u.ply").out.find("b.off:1+b.off:2: 6 faces") != std::string::npos);
  check_refused(here.nef("union b.off b.off --origins"), "-o");
  check_refused(here.nef("union b.off b.off --origins -o u.nef"), "mesh format");
  check_refused(here.nef("union b.off b.off --origins --repeat 2 -o u.obj"), "--repeat");
}

TEST_CASE("info tells measures in doubles, and exact ones where they are short or wanted") {
  const Workplace here;
  REQUIRE(here.nef("eval 'box(0,0,0, 3,3,1) - box(1,1,0, 2,2,1)' -o ring.nef").code == 0);
  const json ring = here.nef("info ring.nef --json").json()["result"];
  CHECK(ring["genus"] == json::array({1, 1}));
  CHECK(ring["volume"] == "8");
  CHECK(ring["volume_digits"] == 1);
  CHECK(ring["centroid"] == json::array({1.5, 1.5, 0.5}));
  CHECK(ring["centroid_exact"] == json::array({"3/2", "3/2", "1/2"}));
  // About z: that of the plate, 9 (3^2 + 3^2) / 12, less that of the hole, (1 + 1) / 12.
  CHECK(ring["inertia"][2][2].get<double>() == Approx(13.5 - 1.0 / 6));
  CHECK(ring["inertia"][0][1] == 0.0);
  CHECK(ring["principal_moments"][2].get<double>() == Approx(13.5 - 1.0 / 6));
  const std::string text = here.nef("info ring.nef").out;
  CHECK(text.find("volume: 8\n") != std::string::npos);
  CHECK(text.find("centroid: [1.5,1.5,0.5]\n") != std::string::npos);

  // An exact volume of 200 digits over 201.
  REQUIRE(here.nef("eval 'box(1e-200,0,0, 1,1,1)' -o long.nef").code == 0);
  const json longer = here.nef("info long.nef --json").json()["result"];
  CHECK(longer["volume"].is_null());
  CHECK(longer["volume_double"] == 1.0);
  CHECK(longer["volume_digits"].is_null());
  CHECK(longer["volume_error"].get<double>() < 1e-12);
  CHECK(longer["area_error"].get<double>() < 1e-12);
  CHECK(longer["centroid"][0].get<double>() == Approx(0.5));
  CHECK(longer["centroid_exact"].is_null());
  CHECK(longer["centroid_error"].get<double>() < 1e-12);
  CHECK(longer["inertia"][2][2].get<double>() == Approx(1.0 / 6));
  CHECK(longer["inertia_error"].get<double>() < 1e-12);
  CHECK(longer["bbox_exact"].is_null());
  CHECK(here.nef("info long.nef").out.find("volume: 1.0 (off by at most ") != std::string::npos);
  CHECK(here.nef("info long.nef --exact --json").json()["result"]["volume"].get<std::string>() ==
        std::string(200, '9') + "/1" + std::string(200, '0'));
  CHECK(here.nef("info long.nef --exact --json").json()["result"]["volume_digits"] == 401);
  REQUIRE(here.nef("eval 'halfspace(0,0,1,0)' -o half.nef").code == 0);
  CHECK(here.nef("info half.nef").out.find("volume: infinite\n") != std::string::npos);
}

TEST_CASE("equality: exit code 0 or 1") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  here.write("b.off", cube_off(1, 3));
  REQUIRE(here.nef("transform a.off --translate 1,1,1 -o c.nef").code == 0);
  CHECK(here.nef("equal b.off c.nef").code == 0);
  CHECK(here.nef("equal a.off b.off").code == 1);
  CHECK(here.nef("equal a.off b.off --json").json()["equal"] == false);
  CHECK(here.nef("equal b.off c.nef --quiet").out.empty());
  // An open cube is another set than a closed one.
  REQUIRE(here.nef("interior a.off -o open.nef").code == 0);
  CHECK(here.nef("equal a.off open.nef").code == 1);
  REQUIRE(here.nef("closure open.nef -o closed.nef").code == 0);
  CHECK(here.nef("equal a.off closed.nef").code == 0);
}

TEST_CASE("unary operations") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const json outside = here.nef("complement a.off --json").json()["result"];
  CHECK(outside["bounded"] == false);
  CHECK(outside["volume"].is_null());
  CHECK(outside["volume_double"].is_null());
  CHECK(outside["open"] == true);
  CHECK(outside["vertices"] == 8);
  CHECK(here.nef("interior a.off --json").json()["result"]["open"] == true);
  const json shell = here.nef("boundary a.off --json").json()["result"];
  CHECK(shell["closed"] == true);
  CHECK(shell["regular"] == false);
  CHECK(shell["volume"] == "0");
  CHECK(shell["volumes"] == 2);
  CHECK(here.nef("exterior a.off --json").json()["result"]["open"] == true);
  CHECK(here.nef("regularize a.off --json").json()["result"]["regular"] == true);
}

TEST_CASE("transformations are done in the order given") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const auto box = [&](const std::string& steps) {
    return here.nef("transform a.off " + steps + " --json").json()["result"]["bbox"];
  };
  CHECK(box("--translate 1,0,0 --scale 3") == json::parse("[[3,0,0],[9,6,6]]"));
  CHECK(box("--scale 3 --translate 1,0,0") == json::parse("[[1,0,0],[7,6,6]]"));
  CHECK(box("--translate 1,0,0 --scale 2 --translate -1,0,0") == json::parse("[[1,0,0],[5,4,4]]"));
  CHECK(box("--rotate z,90") == json::parse("[[-2,0,0],[0,2,2]]"));
  CHECK(box("--rotate 0,0,5,90,1e-3") == json::parse("[[-2,0,0],[0,2,2]]"));
  CHECK(box("--scale 1/2,1,-1") == json::parse("[[0,0,-2],[1,2,0]]"));
  CHECK(box("--matrix 1,0,0,5,0,1,0,0,0,0,1,0") == json::parse("[[5,0,0],[7,2,2]]"));
  CHECK(box("--matrix '2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 2'") == json::parse("[[0,0,0],[2,2,2]]"));
  // A rotation changes no volume, not by a bit.
  CHECK(here.nef("transform a.off --rotate 1,2,3,33.3,1e-6 --json").json()["result"]["volume"] == "8");
}

TEST_CASE("locate and ray") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const json found = here.nef("locate a.off 0,0,0 1,0,0 1,1,0 1,1,1 -1,-1,-1 1,1,1/3 --json").json()["points"];
  const std::vector<std::string> kinds{"vertex", "edge", "facet", "volume", "volume", "volume"};
  REQUIRE(found.size() == kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    CHECK(found[i]["kind"] == kinds[i]);
    CHECK(found[i]["selected"] == (i != 4));
  }
  CHECK(found[5]["point"] == json::array({"1", "1", "1/3"}));
  CHECK(here.nef("locate a.off 1,1,0").out == "1,1,0: facet, selected\n");
  const json hit = here.nef("ray a.off -1,1/3,1 1,0,0 --json").json()["hit"];
  CHECK(hit["kind"] == "facet");
  CHECK(hit["point"] == json::array({"0", "1/3", "1"}));
  CHECK(here.nef("ray a.off -1,0,0 -1,0,0 --json").json()["hit"].is_null());
  CHECK(here.nef("ray a.off -1,0,0 1,0,0").out == "0,0,0: vertex, selected\n");
}

TEST_CASE("conversion keeps the set, through every format") {
  const Workplace here;
  here.write("a.off", cube_off(-1, 2));
  std::string last = "a.off";
  for (const char* extension : {"obj", "stl", "ply", "nef", "nef3", "off"}) {
    const std::string next = std::string("copy.") + extension;
    CAPTURE(next);
    REQUIRE(here.nef("convert " + last + " -o " + next).code == 0);
    CHECK(here.nef("equal a.off " + next).code == 0);
    last = next;
  }
}

TEST_CASE("what a mesh cannot hold is reported") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const Outcome open = here.nef("interior a.off -o open.off");
  CHECK(open.code == 0);
  CHECK(open.err.empty());  // only in the report: every difference of closed sets has an open boundary
  const Outcome flat = here.nef("eval 'file(\"a.off\") + segment(0,0,0, 5,5,5)' -o flat.off");
  CHECK(flat.err.rfind("nef: note: ", 0) == 0);
  const Outcome json = here.nef("interior a.off -o open.off --json --quiet");
  CHECK(json.err.empty());
  CHECK(json.json()["messages"].size() > 0);
}

TEST_CASE("expressions on the command line") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  CHECK(here.nef("eval 'box(0,0,0,1,1,1) * halfspace(1,1,1,-1)' --json").json()["result"]["volume"] == "1/6");
  CHECK(here.nef("eval 'file(\"a.off\") - box(0,0,0, 1,2,2)' --json").json()["result"]["volume"] == "4");
  CHECK(here.nef("eval 'box(0,0,0, 0.1,0.1,0.1)' --json").json()["result"]["volume"] == "1/1000");
  const json half = here.nef("eval 'halfspace(1,2,3,4)' --json").json()["result"];
  CHECK(half["vertices"] == 0);
  CHECK(half["edges"] == 0);
  CHECK(half["facets"] == 1);
  CHECK(half["volumes"] == 2);
  CHECK(half["bounded"] == false);
  CHECK(half["closed"] == true);
  CHECK(half["volume"].is_null());
  CHECK(half["area"].is_null());
  CHECK(half["bbox"].is_null());
  check_refused(here.nef("eval 'box(0,0,0,1,1,1) +'"), "column 19");
  check_refused(here.nef("eval 'file(\"none.off\")'"), "none.off");
}

TEST_CASE("files are written whole or not at all") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  here.write("out.off", "precious");
  check_refused(here.nef("union a.off missing.off -o out.off"), "missing.off");
  CHECK(here.read("out.off") == "precious");
  REQUIRE(here.nef("convert a.off -o out.off").code == 0);
  CHECK(here.nef("equal a.off out.off").code == 0);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(here / "")) ++files;
  CHECK(files == 4);  // a.off, out.off, stdout.txt, stderr.txt: no temporary is left
}

}  // namespace nef::test
