// SPDX-License-Identifier: Apache-2.0
//
// Bad files of every kind: one line on stderr, exit code 2; and what `check` calls by name.
#include "command/process.h"
#include "tests/support/paths.h"

namespace nef::test {
namespace {

// A cube with one line replaced.
std::string with_line(std::size_t number, const std::string& line) {
  std::istringstream in(cube_off(0, 2));
  std::string text;
  std::string part;
  for (std::size_t i = 1; std::getline(in, part); ++i) text += (i == number ? line : part) + "\n";
  return text;
}

std::string cube_without_last_face() {
  std::string text = cube_off(0, 2);
  text.replace(text.find("8 6 0"), 5, "8 5 0");
  return text.substr(0, text.rfind("4 1 3 7 5"));
}

}  // namespace

TEST_CASE("malformed files are refused in one line") {
  const Workplace here;
  here.write("empty.off", "");
  here.write("blank.off", " \n\n");
  here.write("count.off", with_line(2, "9 6 0"));
  here.write("nan.off", with_line(4, "nan 0 0"));
  here.write("word.off", with_line(4, "0 zero 0"));
  here.write("index.off", with_line(11, "4 0 2 3 99"));
  here.write("negative.off", with_line(11, "4 0 2 3 -1"));
  here.write("short.off", cube_off(0, 2).substr(0, 60));
  here.write("magic.off", "hello world\n");
  here.write("short.stl", std::string(80, ' ') + std::string("\x0c\0\0\0", 4) + std::string(70, '\0'));
  std::filesystem::create_directory(here / "dir.off");
  for (const char* file : {"empty.off", "blank.off", "count.off", "nan.off", "word.off", "index.off", "negative.off",
                           "short.off", "magic.off", "short.stl", "dir.off", "missing.off"}) {
    CAPTURE(file);
    check_refused(here.nef(std::string("info ") + file), file);
    check_refused(here.nef(std::string("union ") + file + " " + file + " -o out.off --json"), file);
  }
}

TEST_CASE("folded surfaces are refused in the same words on any number of threads") {
  const Workplace here;
  here.write("good.off", cube_off(0, 2));
  here.write("triangle.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n");
  here.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n4 3 2 1 0\n");
  here.write("open.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  for (const std::string threads : {" --threads 1", " --threads 2", " --threads 4"}) {
    for (const std::string file : {"triangle.off", "square.off"}) {
      CAPTURE(file, threads);
      const std::string complaint = file + ": the faces of the mesh enclose nothing";
      check_refused(here.nef("info " + file + threads), complaint);
      check_refused(here.nef("union good.off " + file + threads + " -o out.off"), complaint);
      const Outcome checked = here.nef("check " + file + threads);
      CHECK(checked.code == 1);
      CHECK(checked.out.find("no volume: the faces of the mesh enclose nothing") != std::string::npos);
    }
    for (const std::string file : {"triangle.off", "square.off", "open.off"}) {
      CAPTURE(file, threads);
      for (const std::string fill : {"", " --fill-holes"}) {
        const Outcome repaired = here.nef("repair " + file + fill + threads + " -o out.off");
        CHECK(repaired.code == 1);
        CHECK(repaired.out.find("still not a valid solid: ") != std::string::npos);
      }
    }
  }
}

TEST_CASE("a mesh without vertices and faces is the empty set everywhere, and is said to be") {
  const Workplace here;
  here.write("empty.off", "OFF\n0 0 0\n");
  here.write("empty.stl", "solid none\nendsolid none\n");
  here.write("cloud.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n");
  for (const std::string file : {"empty.off", "empty.stl"}) {
    for (const std::string& command : {"info " + file, "check " + file, "convert " + file + " -o out.nef",
                                       "union " + file + " " + file + " -o out.nef"}) {
      CAPTURE(command);
      const Outcome outcome = here.nef(command);
      CHECK(outcome.code == 0);
      CHECK((outcome.out + outcome.err).find("has no faces, so it is the empty set") != std::string::npos);
    }
  }
  CHECK(here.nef("repair empty.off -o out.off").code == 0);
  for (const std::string command : {"info cloud.off", "convert cloud.off -o out.nef", "info cloud.off --as-surface"}) {
    CAPTURE(command);
    check_refused(here.nef(command), "cloud.off: the mesh has 2 vertices but no faces");
  }
  CHECK(here.nef("check cloud.off").code == 1);
  CHECK(here.nef("repair cloud.off -o out.off").code != 0);
}

TEST_CASE("what a message quotes from a file can not fool a terminal") {
  const Workplace here;
  here.write("escape.off", with_line(4, "\x1b[2J\x07 0 0"));
  const Outcome outcome = here.nef("info escape.off");
  check_refused(outcome, "'\\x1b[2J\\x07'");
  check_refused(here.nef("eval 'nothing \xc3\x97 nothing'"), "found '\xc3\x97'");
}

TEST_CASE("meshes that bound no solid are refused, with the guilty elements") {
  const Workplace here;
  here.write("open.off", cube_without_last_face());
  check_refused(here.nef("info open.off"), "edge 3-1");
  CHECK(here.nef("info open.off --as-surface --json").json()["result"]["volume"] == "0");
  CHECK(here.nef("info open.off --as-surface --json").json()["result"]["facets"] == 5);

  here.write("turned.off", with_line(11, "4 1 3 2 0"));
  check_refused(here.nef("info turned.off"), "turned.off");

  // Two cubes in one file that cross.
  here.write("crossing.obj", [] {
    std::ostringstream text;
    for (const int shift : {0, 1}) {
      for (int i = 0; i < 8; ++i) {
        text << "v " << 2 * (i & 1) + shift << ' ' << (i & 2) + shift << ' ' << (i & 4) / 2 + shift << '\n';
      }
    }
    for (const int b : {0, 8}) {
      const int faces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
      for (const auto& f : faces) {
        text << 'f';
        for (const int v : f) text << ' ' << v + b;
        text << '\n';
      }
    }
    return text.str();
  }());
  check_refused(here.nef("info crossing.obj --crossings refuse"),
                "crossings=\"union\" selects points that are enclosed");
  const Outcome crossing = here.nef("info crossing.obj --json");
  CHECK(crossing.code == 0);
  CHECK(crossing.err.find("6 pairs of faces cross; selected points that are enclosed at least once") !=
        std::string::npos);
  CHECK(crossing.json()["result"]["volume"] == "15");
  CHECK(here.nef("info crossing.obj --json -q --crossings odd").json()["result"]["volume"] == "14");
  check_refused(here.nef("info crossing.obj --crossings both"), "both");
  const Outcome checked = here.nef("check crossing.obj --json");
  CHECK(checked.code == 1);
  CHECK(checked.json()["ok"] == false);
  CHECK(checked.json()["problems"][0]["name"] == "self-intersection");
  CHECK(checked.json()["problems"][0]["faces"].size() == 2);
}

TEST_CASE("faces that are not planar are triangulated and reported, or refused") {
  const Workplace here;
  here.write("bent.off", with_line(10, "2 2 2.001"));
  const Outcome info = here.nef("info bent.off --json");
  REQUIRE(info.code == 0);
  CHECK(info.err.find("face") != std::string::npos);
  CHECK(info.json()["messages"].size() >= 1);
  CHECK(here.nef("info bent.off --quiet --json").err.empty());
  check_refused(here.nef("info bent.off --strict"), "planar");
}

TEST_CASE("check names what is wrong") {
  const Workplace here;
  here.write("good.off", cube_off(0, 2));
  const Outcome good = here.nef("check good.off");
  CHECK(good.code == 0);
  CHECK(here.nef("check good.off --json").json()["ok"] == true);

  const auto first_problem = [&](const std::string& text) {
    here.write("bad.off", text);
    const Outcome outcome = here.nef("check bad.off --json");
    CHECK(outcome.code == 1);
    return outcome.json()["problems"][0]["name"].get<std::string>();
  };
  CHECK(first_problem(cube_without_last_face()) == "open border");
  CHECK(first_problem(with_line(11, "4 0 2 3 99")) == "bad index");
  CHECK(here.nef("check bad.off --json").json()["problems"][0]["faces"] == nlohmann::json::array({0}));
  CHECK(first_problem(with_line(4, "nan 0 0")) == "not a number");
  CHECK(here.nef("check bad.off --json").json()["problems"][0]["vertices"] == nlohmann::json::array({1}));
  CHECK(first_problem(with_line(11, "4 1 3 2 0")) == "inconsistent orientation");
  CHECK(first_problem("OFF 2 0 0\n0 0 0\n1 0 0\n") == "no faces");
  CHECK(first_problem("OFF 3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n") == "duplicate face");
  CHECK(here.nef("check bad.off --json").json()["problems"].back()["name"] == "no volume");
  check_refused(here.nef("check missing.off"), "missing.off");
  // A face that is only bent is no obstacle.
  here.write("bent.off", with_line(10, "2 2 2.001"));
  CHECK(here.nef("check bent.off").code == 0);
  CHECK(here.nef("check bent.off").out.find("note: non-planar face") != std::string::npos);
}

TEST_CASE("components that contradict each other are refused") {
  const Workplace here;
  // Two boxes in one file; the second one is turned over if asked for.
  const auto boxes = [](int low, int high, int low2, int high2, bool turned) {
    const std::string first = cube_off(low, high);
    const std::string second = cube_off(low2, high2);
    const auto vertices = [](const std::string& off) { return off.substr(10, off.find("4 0 2 3 1") - 10); };
    std::string text = "OFF\n16 12 0\n" + vertices(first) + vertices(second) + first.substr(first.find("4 0 2 3 1"));
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
      text += "4";
      for (int i = 0; i < 4; ++i) text += " " + std::to_string(8 + f[turned ? 3 - i : i]);
      text += "\n";
    }
    return text;
  };
  here.write("cavity.off", boxes(0, 9, 2, 5, true));
  CHECK(here.nef("info cavity.off --json").json()["result"]["volume"] == "702");
  here.write("beside.off", boxes(0, 3, 5, 9, false));
  CHECK(here.nef("info beside.off --json").json()["result"]["volume"] == "91");
  here.write("nested.off", boxes(0, 9, 2, 5, false));
  here.write("turned.off", boxes(0, 3, 5, 9, true));
  for (const std::string file : {"nested.off", "turned.off"}) {
    CAPTURE(file);
    check_refused(here.nef("info " + file + " --crossings refuse"), "begin at faces 0, 6");
    const Outcome checked = here.nef("check " + file + " --json");
    CHECK(checked.code == 1);
    CHECK(checked.json()["problems"].back()["name"] == "inconsistent orientation");
    CHECK(here.nef("info " + file).err.find("points that are enclosed at least once") != std::string::npos);
  }
  CHECK(here.nef("info nested.off --json").json()["result"]["volume"] == "729");
  // The larger box decides that the mesh is inside out; the smaller one is so then.
  CHECK(here.nef("info turned.off --json").json()["result"]["volume"] == "64");
  CHECK(here.nef("info turned.off --crossings nonzero --json").json()["result"]["volume"] == "91");
}

TEST_CASE("two cubes that share an edge or a vertex are legal") {
  const Workplace here;
  for (const std::string other : {"2,2,0, 4,4,2", "2,2,2, 4,4,4"}) {
    CAPTURE(other);
    REQUIRE(here.nef("eval 'box(0,0,0, 2,2,2) + box(" + other + ")' -o two.off").code == 0);
    CHECK(here.nef("check two.off").code == 0);
    CHECK(here.nef("info two.off --json").json()["result"]["volume"] == "16");
  }
}

TEST_CASE("names of files may be any bytes") {
  const Workplace here;
  const std::string name = "caf\xe9.off";
  here.write(name, cube_off(0, 1));
  for (const char* output : {"a.html", "a.glb"}) {
    const Outcome outcome = here.nef("view '" + name + "' -o " + output);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(here.read(output).size() > 100);
  }
  CHECK(here.nef("view '" + name + "' --json -o a.glb").json()["layers"] == 1);
  CHECK(here.nef("info '" + name + "' --json").code == 0);
}

TEST_CASE("a mesh from a pipe is read once") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const std::string command = "cd '" + here.path().string() + "' && cat a.off | '" + program_folder() +
                              "/nef' info /dev/stdin --json > out.json";
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(nlohmann::json::parse(here.read("out.json"))["result"]["volume"] == "8");
}

TEST_CASE("A mesh that touches itself is a solid, and is written as one") {
  const Workplace here;
  // Tetrahedra that stand on a cube: one with a corner inside its top, one with an edge inside its floor.
  std::string text = cube_off(0, 4);
  text.replace(text.find("8 6 0"), 5, "16 14 0");
  const std::size_t faces = text.find("4 0 2 3 1");
  text = text.substr(0, faces) + "2 2 4\n1 1 5\n3 1 5\n2 3 5\n" + "1 2 0\n3 2 0\n2 1 -1\n2 3 -1\n" +
         text.substr(faces) + "3 9 10 11\n3 8 10 9\n3 8 11 10\n3 8 9 11\n" +
         "3 12 14 13\n3 12 13 15\n3 12 15 14\n3 13 14 15\n";
  here.write("touching.off", text);
  const Outcome checked = here.nef("info touching.off --json");
  CAPTURE(checked.err);
  REQUIRE(checked.code == 0);
  CHECK(checked.json()["result"]["volume"] == "196/3");
  CHECK(here.nef("convert touching.off -o a.off").code == 0);
  CHECK(here.nef("check a.off").code == 0);
}

TEST_CASE("many notes of one file are a few lines, and all of them in JSON") {
  const Workplace here;
  // Five cubes, each with a corner pulled out: three bent faces each.
  std::string vertices;
  std::string faces;
  for (int k = 0; k < 5; ++k) {
    std::istringstream cube(cube_off(10 * k, 10 * k + 2));
    std::string line;
    for (int i = 0; std::getline(cube, line); ++i) {
      if (i < 2) continue;
      if (i == 9)
        line = std::to_string(10 * k + 3) + " " + std::to_string(10 * k + 3) + " " + std::to_string(10 * k + 4);
      if (i < 10) {
        vertices += line + "\n";
        continue;
      }
      std::istringstream corners(line);
      int count = 0;
      corners >> count;
      faces += "4";
      for (int corner = 0; corners >> corner;) faces += " " + std::to_string(corner + 8 * k);
      faces += "\n";
    }
  }
  here.write("bent.off", "OFF\n40 30 0\n" + vertices + faces);
  const Outcome outcome = here.nef("info bent.off");
  REQUIRE(outcome.code == 0);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 6);
  CHECK(outcome.err.find("and 10 more") != std::string::npos);
  CHECK(here.nef("info bent.off --json").json()["messages"].size() == 15);
}

}  // namespace nef::test
