// SPDX-License-Identifier: Apache-2.0
//
// nef apply: many steps on one set.
#include "command/process.h"

namespace nef::test {
namespace {

using nlohmann::json;

// A lattice of boxes taken off, some put back.
std::string lattice(int n) {
  std::ostringstream text;
  text << "# steps\n\n";
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      text << "- box(" << i << ".25," << k << ".25,-1, " << i << ".75," << k << ".75,1)  # a hole\n";
    }
    text << "+ box(" << i << ",0,0, " << i << ".5,1/2,1/2)\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("steps of all operators, with comments, and the promised JSON") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  here.write("steps.txt",
             "# from a cube\n\n  - box(1,1,1, 2,2,2)\n+ translate(file(\"a.off\"), 3,0,0) # beside it\r\n"
             "*\thalfspace(0,0,1,-1)\n^ box(0,0,0, 1,1,1)");
  const Outcome run = here.nef("apply a.off --steps steps.txt -o b.nef --json");
  REQUIRE(run.code == 0);
  const json report = run.json();
  CHECK(report["command"] == "apply");
  REQUIRE(report["steps"].size() == 4);
  const std::vector<int> lines{3, 4, 5, 6};
  const std::vector<std::string> operators{"-", "+", "*", "^"};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(report["steps"][i]["line"] == lines[i]);
    CHECK(report["steps"][i]["operator"] == operators[i]);
    CHECK(report["steps"][i]["op_s"].get<double>() >= 0);
    CHECK(report["steps"][i]["tiles"].is_null());
  }
  // [0,2]^3 without its upper corner has 7, below z = 1 it has 4, 3 of them outside of the unit cube; and 4 beside it.
  CHECK(report["result"]["volume"] == "7");
  const Outcome eval = here.nef(
      "eval '(file(\"a.off\") - box(1,1,1, 2,2,2) + translate(file(\"a.off\"), 3,0,0)) * halfspace(0,0,1,-1) ^ "
      "box(0,0,0, 1,1,1)' -o c.nef");
  REQUIRE(eval.code == 0);
  CHECK(here.nef("equal b.nef c.nef").code == 0);
}

TEST_CASE("the same file whatever the tiles and the threads") {
  const Workplace here;
  here.write("a.off", cube_off(0, 5));
  here.write("steps.txt", lattice(5));
  std::string first;
  for (const std::string flags : {"--tiles off", "--tiles auto", "--tiles 40", "--tiles 100 --threads 1",
                                  "--tiles 100 --threads 2", "--tiles 64 --threads 0"}) {
    CAPTURE(flags);
    const Outcome run = here.nef("apply a.off --steps steps.txt -o b.nef --json " + flags);
    REQUIRE(run.code == 0);
    const json last = run.json()["steps"].back();
    if (flags.rfind("--tiles off", 0) == 0) CHECK(last["tiles"].is_null());
    if (flags.find("0 --threads") != std::string::npos) CHECK(last["tiles"].get<int>() > 1);
    if (first.empty()) first = here.read("b.nef");
    CHECK(here.read("b.nef") == first);
  }
}

TEST_CASE("wrong steps are told with their line, before anything is computed") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  const auto refused = [&here](const std::string& steps, const std::string& words) {
    here.write("steps.txt", steps);
    check_refused(here.nef("apply a.off --steps steps.txt -o b.nef"), words);
    CHECK_FALSE(std::filesystem::exists(here / "b.nef"));
  };
  refused("- box(0,0,0, 1,1,1)\n\nbox(0,0,0, 1,1,1)\n", "steps.txt: line 3, column 1: a step begins with");
  refused("# none\n- box(0,0,0, 1,1)\n", "steps.txt: line 2, column");
  refused("- file(\"missing.off\")\n", "missing.off");
  refused("-\n", "steps.txt: line 1");
  refused("- polygon(0,0,0, 1,0,0, 1,1,1, 0,1,0)\n", "steps.txt: line 1, column");
  here.write("steps.txt", "- box(0,0,0, 1,1,1)\n");
  check_refused(here.nef("apply a.off --steps steps.txt --tiles 3 -o b.nef"), "--tiles");
  check_refused(here.nef("apply a.off --steps steps.txt --tiles -5 -o b.nef"), "--tiles");
  check_refused(here.nef("apply a.off --steps steps.txt --tiles many -o b.nef"), "many");
  check_refused(here.nef("apply a.off --steps nowhere.txt -o b.nef"), "nowhere.txt");
  check_refused(here.nef("apply a.off -o b.nef"), "--steps");
}

TEST_CASE("the difference from several sets") {
  const Workplace here;
  here.write("a.off", cube_off(0, 3));
  here.write("b.off", cube_off(0, 1));
  here.write("c.off", cube_off(2, 3));
  const Outcome run = here.nef("difference a.off b.off c.off --json");
  REQUIRE(run.code == 0);
  CHECK(run.json()["result"]["volume"] == "25");
}

TEST_CASE("sets stay in tiles, in a folder, within a bound on memory") {
  const Workplace here;
  here.write("a.off", cube_off(0, 8));
  here.write("steps.txt", lattice(7));
  REQUIRE(here.nef("apply a.off --steps steps.txt -o plain.nef").code == 0);
  const Outcome first = here.nef("apply a.off --steps steps.txt --tiles 100 --memory 100K -o b.tiles --json");
  REQUIRE(first.code == 0);
  CHECK(first.json()["result"]["tiles"].get<int>() > 4);
  CHECK(first.json()["result"]["tiles_put_in_files"].get<int>() > 0);
  CHECK(here.file_count() == 6);  // with stdout and stderr: nothing else is left
  // Read back by every subcommand.
  REQUIRE(here.nef("convert b.tiles -o c.nef").code == 0);
  CHECK(here.nef("equal c.nef plain.nef").code == 0);
  // Steps on what is in tiles already, to the same folder and to a file.
  here.write("more.txt", "- box(0,0,0, 1/4,1/4,1/4)\n+ box(20,0,0, 21,1,1)\n");
  REQUIRE(here.nef("apply plain.nef --steps more.txt -o plain2.nef").code == 0);
  REQUIRE(here.nef("apply b.tiles --steps more.txt -o glued.nef").code == 0);
  CHECK(here.read("glued.nef") == here.read("plain2.nef"));
  REQUIRE(here.nef("apply b.tiles --steps more.txt -o b.tiles").code == 0);
  REQUIRE(here.nef("convert b.tiles -o d.nef").code == 0);
  CHECK(here.read("d.nef") == here.read("plain2.nef"));
  // Booleans on them.
  REQUIRE(here.nef("difference b.tiles plain.nef a.off -o e.tiles").code == 0);
  CHECK(here.nef("info e.tiles --json").json()["result"]["volume"] == "1");
  REQUIRE(here.nef("union b.tiles a.off --memory 50K -o f.off").code == 0);
  // Several operands in tiles.
  REQUIRE(here.nef("convert a.off -o a.tiles").code == 0);
  for (const std::string operation : {"union", "intersection", "difference", "symdiff"}) {
    REQUIRE(here.nef(operation + " b.tiles a.tiles --memory 50K -o g.tiles").code == 0);
    REQUIRE(here.nef(operation + " d.nef a.off -o g.nef").code == 0);
    CHECK(here.nef("equal g.tiles g.nef").code == 0);
  }
  CHECK(here.nef("info f.off --json").json()["result"]["volume"] == "513");
}

TEST_CASE("very many files are united region by region where the result stays in tiles") {
  const Workplace here;
  // A thousand boxes, some of which overlap, touch or hold others, and a block to take them from.
  std::string names;
  constexpr int kCount = 1000;
  for (int i = 0; i < kCount; ++i) {
    const int low = 3 * (i % 10);
    const int size = 1 + i % 4;
    const std::array<int, 3> corner{low, 3 * (i / 10 % 10), 3 * (i / 100)};
    const std::string name = std::to_string(i) + ".off";
    here.write(name, box_off(corner, {corner[0] + size, corner[1] + size, corner[2] + 2}));
    names += " " + name;
  }
  here.write("block.off", cube_off(-1, 20));
  REQUIRE(here.nef("union" + names + " -o plain.nef --tiles off").code == 0);
  REQUIRE(here.nef("union" + names + " -o auto.nef").code == 0);
  CHECK(here.read("auto.nef") == here.read("plain.nef"));  // a file is written without tiles
  for (const std::string flags : {"-o r.tiles", "-o r.tiles --threads 1", "-o r.tiles --memory 100K",
                                  "-o r.tiles --tiles 64", "-o r.tiles --tiles off"}) {
    CAPTURE(flags);
    const Outcome run = here.nef("union" + names + " --json " + flags);
    REQUIRE(run.code == 0);
    const bool regions = run.out.find("read_operands") != std::string::npos;
    CHECK(regions == (flags.find("off") == std::string::npos));
    CHECK(here.nef("equal r.tiles plain.nef").code == 0);
    CHECK(here.nef("equal r.tiles r.tiles").code == 0);
    CHECK(here.nef("equal block.off r.tiles").code == 1);
  }
  REQUIRE(here.nef("difference block.off" + names + " -o d.nef").code == 0);
  const Outcome difference = here.nef("difference block.off" + names + " -o d.tiles --json");
  REQUIRE(difference.code == 0);
  CHECK(difference.out.find("read_operands") != std::string::npos);
  CHECK(here.nef("equal d.tiles d.nef").code == 0);
  // All in one place, where nothing divides them.
  std::string same;
  for (int i = 0; i < kCount; ++i) same += " 7.off";
  const Outcome crowd = here.nef("union" + same + " -o s.tiles --json");
  REQUIRE(crowd.code == 0);
  CHECK(here.nef("equal s.tiles 7.off").code == 0);
  // What cannot be read is named.
  check_refused(here.nef("union" + names + " missing.off -o m.tiles"), "missing.off");
}

TEST_CASE("sets that lie everywhere are not united region by region") {
  const Workplace here;
  // Bars from one end to the other, in three directions, past each other: a region would meet many of them.
  std::string names;
  int count = 0;
  for (int i = 0; i < 19; ++i) {
    for (int k = 0; k < 19; ++k) {
      for (const std::string& bar : {box_off({0, 6 * i, 6 * k}, {160, 6 * i + 1, 6 * k + 1}),
                                     box_off({6 * i, 0, 6 * k + 2}, {6 * i + 1, 160, 6 * k + 3}),
                                     box_off({6 * i + 2, 6 * k + 2, 0}, {6 * i + 3, 6 * k + 3, 160})}) {
        const std::string name = std::to_string(count++) + ".off";
        here.write(name, bar);
        names += " " + name;
      }
    }
  }
  for (const std::string memory : {"", " --memory 100M"}) {
    const Outcome run = here.nef("union" + names + " -o b.tiles --json" + memory);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("read_operands") == std::string::npos);  // what regions report
    CHECK(here.nef("info b.tiles --json").json()["result"]["volume"] == std::to_string(160 * count));
  }
}

TEST_CASE("a run that is killed while it writes a folder leaves the old set or the new one") {
  const Workplace here;
  here.write("a.off", cube_off(0, 8));
  here.write("steps.txt", lattice(7));
  here.write("more.txt", "- halfspace(1,2,3,-24)\n");
  REQUIRE(here.nef("apply a.off --steps steps.txt --tiles 40 -o old.tiles").code == 0);
  REQUIRE(here.nef("apply old.tiles --steps more.txt -o new.nef").code == 0);
  int killed = 0;
  for (int delay = 1; delay <= 12; ++delay) {
    const std::string seconds =
        "0.0" + std::string(delay < 5 ? "0" : "") + std::to_string(delay < 5 ? 2 * delay : delay - 4);
    const std::string command = "cd '" + here.path().string() +
                                "' && rm -rf b.tiles && cp -r old.tiles b.tiles && timeout -s KILL " + seconds + " '" +
                                program_folder() + "/nef' apply b.tiles --steps more.txt -o b.tiles > out.txt 2>&1";
    if (std::system(command.c_str()) != 0) ++killed;
    CAPTURE(seconds);
    CHECK((here.nef("equal b.tiles old.tiles").code == 0 || here.nef("equal b.tiles new.nef").code == 0));
  }
  CHECK(killed > 0);
  // The next run finishes.
  REQUIRE(here.nef("apply old.tiles --steps more.txt -o b.tiles").code == 0);
  CHECK(here.nef("equal b.tiles new.nef").code == 0);
}

TEST_CASE("sets in tiles are asked without being glued") {
  const Workplace here;
  here.write("a.off", cube_off(0, 8));
  here.write("steps.txt", lattice(7));
  REQUIRE(here.nef("apply a.off --steps steps.txt -o plain.nef").code == 0);
  REQUIRE(here.nef("apply a.off --steps steps.txt --tiles 100 -o b.tiles").code == 0);
  const nlohmann::json whole = here.nef("info plain.nef --json").json()["result"];
  const nlohmann::json tiled = here.nef("info b.tiles --json").json()["result"];
  for (const char* key : {"volume", "volume_double", "volume_digits", "bbox", "bbox_exact"}) {
    CHECK(tiled[key] == whole[key]);
  }
  CHECK(tiled["tiles"].get<int>() > 4);
  CHECK(here.nef("info b.tiles --glued --json").json()["result"] == whole);
  for (const std::string flags : {"--memory 50K", "--memory 1G", "--memory 1 --threads 1"}) {
    CHECK(here.nef("info b.tiles --json " + flags).json()["result"] == tiled);
    CHECK(here.nef("equal b.tiles plain.nef " + flags).code == 0);
    CHECK(here.nef("equal a.off b.tiles " + flags).code == 1);
  }
  const std::string points = "0,0,0 4,4,4 1,1,1 3/2,3/2,3/2 8,8,8 1/2,1/2,1/2 -1,0,0 5/4,5/4,1";
  const nlohmann::json there = here.nef("locate b.tiles --json -- " + points).json()["points"];
  const nlohmann::json expected = here.nef("locate plain.nef --json -- " + points).json()["points"];
  REQUIRE(there.size() == expected.size());
  for (std::size_t i = 0; i < there.size(); ++i) {
    CHECK(there[i]["index"].is_null());
    CHECK(there[i]["kind"] == expected[i]["kind"]);
    CHECK(there[i]["selected"] == expected[i]["selected"]);
  }
  const nlohmann::json hit = here.nef("ray b.tiles --json -- -1,1/3,1/3 1,0,0").json()["hit"];
  CHECK(hit["point"] == here.nef("ray plain.nef --json -- -1,1/3,1/3 1,0,0").json()["hit"]["point"]);
  CHECK(here.nef("ray b.tiles -- -1,1/3,1/3 -1,0,0").out == here.nef("ray plain.nef -- -1,1/3,1/3 -1,0,0").out);
}

TEST_CASE("a long expression of several operators is that of its steps") {
  const Workplace here;
  std::string steps;
  std::string expression = "sphere(10, 60)";
  for (int i = 0; i < 150; ++i) {
    // The same places again and again, with every operator.
    const std::string x = std::to_string(3 * i % 7 - 3);
    const std::string y = std::to_string(5 * i % 11 - 5);
    const std::string step = std::string("-+^-"[i % 4] + std::string(" box(")) + x + "," + y + ",7, " + x + "+1," + y +
                             "+" + std::to_string(1 + i % 2) + ",11)";
    steps += step + "\n";
    expression += "\n " + step;
  }
  here.write("steps.txt", steps);
  here.write("long.txt", expression);
  REQUIRE(here.nef("eval 'sphere(10, 60)' -o sphere.nef").code == 0);
  REQUIRE(here.nef("apply sphere.nef --steps steps.txt --tiles off -o steps.nef").code == 0);
  REQUIRE(here.nef("eval -f long.txt -o long.nef").code == 0);
  CHECK(here.nef("equal long.nef steps.nef").code == 0);
}

TEST_CASE("flags about tiles that say nothing useful are refused") {
  const Workplace here;
  here.write("a.off", cube_off(0, 2));
  for (const std::string memory : {"0", "-1G", "2X", "G", "", "nan", "1e99"}) {
    const Outcome run = here.nef("union a.off a.off --memory '" + memory + "' -o b.nef");
    CAPTURE(memory, run.err);
    CHECK(run.code == (memory.empty() ? 0 : 2));
  }
  CHECK(here.nef("union a.off a.off --tiles off --memory 1G -o b.nef").code == 2);
  CHECK(here.nef("info none.tiles").code == 2);
  CHECK(here.nef("info a.off --memory 1G").code == 2);
  CHECK(here.nef("equal a.off a.off --memory 1G").code == 2);
}

}  // namespace nef::test
