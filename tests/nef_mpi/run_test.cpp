// SPDX-License-Identifier: Apache-2.0
//
// The program nef_mpi as mpirun starts it: the same bytes on any number of ranks, and what happens when one is lost.
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

class Place : public TemporaryFolder {
 public:
  // Runs a program of ours in this folder.
  [[nodiscard]] Outcome run(const std::string& program, const std::string& arguments) const {
    return shell("'" + program_folder() + "/" + program + "' " + arguments);
  }
  // Runs nef_mpi on so many ranks, which may be more than there are cores.
  [[nodiscard]] Outcome ranks(int count, const std::string& arguments) const {
    return shell("env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" NEF_MPIEXEC "' --oversubscribe -n " +
                 std::to_string(count) + " '" + program_folder() + "/nef_mpi' " + arguments);
  }
  [[nodiscard]] std::string read(const std::string& name) const { return slurp(file(name)); }
  // Runs a job that does all of its work and then cannot write its output, so that the work is left.
  void stop_at_output(const std::string& job, const std::string& output) const {
    fs::remove(path() / output);
    fs::create_directory(path() / output);
    CHECK(ranks(1, job + " -o " + output).code == 2);
    REQUIRE(fs::exists(path() / (output + ".work") / "job"));
    fs::remove(path() / output);
  }

 private:
  [[nodiscard]] Outcome shell(const std::string& command) const {
    const int status =
        std::system(("cd '" + path().string() + "' && " + command + " > stdout.txt 2> stderr.txt < /dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
  }
};

// Lines of tetrahedra that meet a few others each.
std::string tetrahedra(int count, unsigned seed) {
  std::mt19937 random(seed);
  const int side = static_cast<int>(100 * std::cbrt(count));
  const auto below = [&random](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
  std::ostringstream text;
  text << "# pieces\n";
  for (int i = 0; i < count; ++i) {
    const int x = below(side);
    const int y = below(side);
    const int z = below(side);
    text << "hull(";
    for (int corner = 0; corner < 4; ++corner) {
      text << (corner == 0 ? "" : ", ") << x + below(120) << "/100," << y + below(120) << "/100," << z + below(120)
           << "/100";
    }
    text << ")\n";
  }
  return text.str();
}

// Lines of bars from one end to the other, in two directions, which cross; so many in a row.
std::string bars(int count = 300, int row = 15) {
  std::string text;
  const std::string end = std::to_string(5 * row);
  for (int i = 0; i < count; ++i) {
    const std::string low = std::to_string(i % row * 5) + ", " + std::to_string(i / row * 5);
    const std::string high = std::to_string(i % row * 5 + 2) + ", " + std::to_string(i / row * 5 + 3);
    text += i % 2 == 0 ? "box(0, " + low + ", " + end + ", " + high + ")\n"
                       : "box(" + low + ", 0, " + high + ", " + end + ")\n";
  }
  return text;
}

// Processes whose command line names both words.
std::vector<pid_t> processes_with(const std::string& program, const std::string& word) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string line = slurp((entry.path() / "cmdline").string());
    const std::string self = line.substr(0, line.find('\0'));
    if (self.ends_with(program) && line.find(word) != std::string::npos) found.push_back(std::stoi(name));
  }
  return found;
}

}  // namespace

TEST_CASE("a union is the same bytes on any number of ranks, and without MPI") {
  const Place here;
  static_cast<void>(here.write("pieces.txt", tetrahedra(700, 1)));
  static_cast<void>(
      here.run("nef", "eval 'box(0,0,0, 3,3,3) - interior(box(1,1,1, 2,2,2)) + halfspace(0,0,1,1)' -o extra.nef"));
  std::string all = "union(file(\"extra.nef\")";
  std::istringstream lines(here.read("pieces.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("hull")) all += ", " + line;
  }
  static_cast<void>(here.write("all.txt", all + ")"));
  REQUIRE(here.run("nef", "eval \"$(cat all.txt)\" -o plain.nef").code == 0);
  // In canonical order, as gluing leaves it.
  REQUIRE(here.run("nef", "convert plain.nef -o plain.tiles").code == 0);
  REQUIRE(here.run("nef", "convert plain.tiles -o canonical.nef").code == 0);
  for (const int ranks : {1, 2, 4, 7}) {
    const std::string name = "r" + std::to_string(ranks) + ".nef";
    const Outcome run = here.ranks(ranks, "union extra.nef --list pieces.txt -o " + name);
    CAPTURE(ranks, run.err);
    REQUIRE(run.code == 0);
    CHECK(here.read(name) == here.read("canonical.nef"));
    CHECK_FALSE(fs::exists(here.path() / (name + ".work")));
  }
  // In tiles, within a bound on memory.
  REQUIRE(here.ranks(3, "union extra.nef --list pieces.txt -o r.tiles --memory 200K").code == 0);
  REQUIRE(here.run("nef", "convert r.tiles -o glued.nef").code == 0);
  CHECK(here.read("glued.nef") == here.read("canonical.nef"));
}

TEST_CASE("a rank that is lost ends the run, and the next one goes on from what is finished") {
  // The last rank or the one that deals out tasks, into a file or a folder of tiles, fewer and more ranks afterwards.
  const bool lose_first = GENERATE(false, true);
  const int before_loss = lose_first ? 4 : 3;
  const std::string output = lose_first ? "u.tiles" : "u.nef";
  CAPTURE(output);
  const Place here;
  static_cast<void>(here.write("pieces.txt", tetrahedra(6000, 2)));
  const fs::path work = here.path() / (output + ".work");
  const auto finished = [&work] {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(work, error)) {
      if (fs::exists(entry.path() / "index", error)) ++count;
    }
    return count;
  };
  const std::string list = here.file("pieces.txt");
  std::future<Outcome> run =
      std::async(std::launch::async, [&] { return here.ranks(before_loss, "union --list " + list + " -o " + output); });
  for (int i = 0; i < 60000 && finished() < 3; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::vector<pid_t> ranks = processes_with("nef_mpi", list);
  std::sort(ranks.begin(), ranks.end());  // mpirun starts them in their order
  REQUIRE(ranks.size() == static_cast<std::size_t>(before_loss));
  REQUIRE(kill(lose_first ? ranks.front() : ranks.back(), SIGKILL) == 0);
  CHECK(run.get().code != 0);
  CHECK_FALSE(fs::exists(here.path() / output));
  CHECK(finished() >= 3);
  const Outcome second = here.ranks(lose_first ? 7 : 2, "union --list " + list + " -o " + output + " --json");
  REQUIRE(second.code == 0);
  CHECK_FALSE(fs::exists(work));
  REQUIRE(here.ranks(1, "union --list " + list + " -o whole.nef").code == 0);
  if (lose_first) REQUIRE(here.run("nef", "convert u.tiles -o u.nef").code == 0);
  CHECK(here.read("u.nef") == here.read("whole.nef"));
}

TEST_CASE("a task that fails is tried again and named, the others are kept") {
  const Place here;
  std::string pieces = tetrahedra(600, 3);
  static_cast<void>(here.write("later.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"));  // cut off
  static_cast<void>(here.write("pieces.txt", pieces + "file(\"later.off\")\n"));
  const Outcome run = here.ranks(2, "union --list pieces.txt -o u.nef");
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains("1 of 2 tasks failed") && Contains("pieces 513 to 601") && Contains("pieces.txt:602") &&
                          Contains("later.off"));
  CHECK_FALSE(fs::exists(here.path() / "u.nef"));
  CHECK(fs::exists(here.path() / "u.nef.work/boxes-0"));
  static_cast<void>(here.run("nef", "eval 'box(-1,-1,-1, 0,0,0)' -o later.off"));
  CHECK(here.ranks(2, "union --list pieces.txt -o u.nef").code == 0);
  // Bad usage is one line, whatever the number of ranks.
  const Outcome bad = here.ranks(2, "union --nonsense -o u.nef");
  CHECK(bad.code == 2);
  CHECK(bad.err.find("nef_mpi: ") == bad.err.rfind("nef_mpi: "));
  CHECK_THAT(here.ranks(2, "union none.off -o u.nef").err, Contains("none.off: no such file"));
  static_cast<void>(here.write("pieces.txt", "box(0,0,0, 1,1,1)  # \" here\n  # none\nfile(\"none.off\")\n"));
  CHECK_THAT(here.ranks(2, "union --list pieces.txt -o u.nef").err, Contains("pieces.txt:3: none.off: no such file"));
  static_cast<void>(here.write("pieces.txt", "\nbox(0,0,0, 1,1\n"));
  CHECK_THAT(here.ranks(2, "union --list pieces.txt -o u.nef").err, Contains("pieces.txt:2: column "));
  CHECK_THAT(here.ranks(2, "union -o u.nef").err, Contains("no pieces"));
}

TEST_CASE("pieces that lie everywhere are united up a tree instead of region by region") {
  const Place here;
  static_cast<void>(here.write("bars.txt", bars()));
  REQUIRE(here.ranks(1, "union --list bars.txt -o one.nef --times times.csv").code == 0);
  CHECK(here.read("times.csv").find("regions") == std::string::npos);
  CHECK(here.read("times.csv").find("unions") != std::string::npos);
  REQUIRE(here.run("nef", "convert one.nef -o one.tiles").code == 0);
  REQUIRE(here.run("nef", "convert one.tiles -o canonical.nef").code == 0);
  CHECK(here.read("one.nef") == here.read("canonical.nef"));
  for (const int ranks : {2, 4, 7}) {
    CAPTURE(ranks);
    REQUIRE(here.ranks(ranks, "union --list bars.txt -o more.nef").code == 0);
    CHECK(here.read("more.nef") == here.read("one.nef"));
  }
  REQUIRE(here.ranks(3, "union --list bars.txt -o bars.tiles --times times.csv").code == 0);
  CHECK(here.read("times.csv").find("regions") == std::string::npos);
  // Regions bound memory, whatever that costs.
  REQUIRE(here.ranks(3, "union --list bars.txt -o bound.tiles --memory 10M --times times.csv").code == 0);
  CHECK(here.read("times.csv").find("regions") != std::string::npos);
  for (const std::string name : {"bars", "bound"}) {
    REQUIRE(here.run("nef", "convert " + name + ".tiles -o glued.nef").code == 0);
    CHECK(here.read("glued.nef") == here.read("one.nef"));
  }
}

TEST_CASE("a rank that is lost inside the tree of unions ends the run, and the next one goes on in the tree") {
  const bool lose_first = GENERATE(false, true);
  const int before_loss = lose_first ? 4 : 3;
  CAPTURE(lose_first);
  const Place here;
  static_cast<void>(here.write("bars.txt", bars(1100, 33)));
  const std::string list = here.file("bars.txt");
  const fs::path work = here.path() / "u.nef.work";
  const auto results = [&work] {
    std::set<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(work, error)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("union-") && name.ends_with(".nef")) names.insert(name);
    }
    return names;
  };
  std::future<Outcome> run =
      std::async(std::launch::async, [&] { return here.ranks(before_loss, "union --list " + list + " -o u.nef"); });
  // A result that is gone has been used up by the union of two.
  std::set<std::string> seen;
  bool inside = false;
  for (int i = 0; i < 60000 && !inside; ++i) {
    const std::set<std::string> now = results();
    inside = !std::includes(now.begin(), now.end(), seen.begin(), seen.end());
    seen.insert(now.begin(), now.end());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(inside);
  std::vector<pid_t> ranks = processes_with("nef_mpi", list);
  std::sort(ranks.begin(), ranks.end());
  REQUIRE(ranks.size() == static_cast<std::size_t>(before_loss));
  REQUIRE(kill(lose_first ? ranks.front() : ranks.back(), SIGKILL) == 0);
  CHECK(run.get().code != 0);
  CHECK_FALSE(fs::exists(here.path() / "u.nef"));
  CHECK_FALSE(results().empty());
  REQUIRE(here.ranks(lose_first ? 7 : 2, "union --list " + list + " -o u.nef --times second.csv").code == 0);
  CHECK_FALSE(fs::exists(work));
  REQUIRE(here.ranks(1, "union --list " + list + " -o whole.nef --times whole.csv").code == 0);
  CHECK(here.read("u.nef") == here.read("whole.nef"));
  const auto unions = [&here](const std::string& name) {
    std::istringstream lines(here.read(name));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with("unions,") ? 1 : 0;
    return count;
  };
  CHECK(unions("second.csv") < unions("whole.csv"));
}

TEST_CASE("a union that fails is named, those that need it are left out, and the others are kept") {
  const Place here;
  static_cast<void>(here.run("nef", "eval 'box(0,0,0, 1,1,1)' -o later.nef"));
  static_cast<void>(here.write("bars.txt", bars() + "file(\"later.nef\")\n"));
  here.stop_at_output("union --list bars.txt", "u.nef");
  for (const auto& entry : fs::directory_iterator(here.path() / "u.nef.work")) {
    if (entry.path().filename() != "job") fs::remove(entry.path());
  }
  // What cannot be read where the result of a task is expected.
  const fs::path work = here.path() / "u.nef.work";
  fs::create_directories(work / "union-3.nef" / "in the way");
  const Outcome run = here.ranks(2, "union --list bars.txt -o u.nef");
  CAPTURE(run.err);
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains("1 of ") && Contains("tasks failed (unions): union "));
  CHECK_FALSE(fs::exists(here.path() / "u.nef"));
  const auto kept = std::count_if(fs::directory_iterator(work), fs::directory_iterator(),
                                  [](const auto& entry) { return entry.path().extension() == ".nef"; });
  CHECK(kept >= 3);
  fs::remove_all(work / "union-3.nef");
  REQUIRE(here.ranks(3, "union --list bars.txt -o u.nef").code == 0);
  static_cast<void>(here.write("bars.txt", bars()));
  REQUIRE(here.ranks(1, "union --list bars.txt later.nef -o again.nef").code == 0);
  CHECK(here.read("u.nef") == here.read("again.nef"));
}

// Replaced files keep their time and size, which is what copies and archives do.
TEST_CASE("a run goes on only from work that was made of the same inputs, whatever their times say") {
  const Place here;
  const auto replace = [&here](const std::string& name, const std::string& expression) {
    const fs::path file = here.path() / name;
    const bool old = fs::exists(file);
    const auto time = old ? fs::last_write_time(file) : fs::file_time_type();
    REQUIRE(here.run("nef", "eval '" + expression + "' --text -o '" + name + "'").code == 0);
    if (old) fs::last_write_time(file, time);
  };
  const std::string before = "translate(box(0,0,0, 1,1,1), 0,0,-3)";
  const std::string after = "translate(box(0,0,0, 1,1,1), 0,0,-4)";
  static_cast<void>(
      here.write("bars.txt", bars() + "box(-9,0,0, 1,1,1) + file(\"a#b.nef\")  # its name has a \"#\"\n"));
  const auto check = [&](const std::string& job, const std::string& changed) {
    CAPTURE(job, changed);
    replace("part.nef", before);
    replace("a#b.nef", before);
    here.stop_at_output(job, "u.nef");
    replace(changed, after);
    REQUIRE(here.ranks(2, job + " -o u.nef").code == 0);
    REQUIRE(here.ranks(1, job + " -o fresh.nef").code == 0);
    CHECK(here.read("u.nef") == here.read("fresh.nef"));
  };
  check("union part.nef --list bars.txt", "a#b.nef");
  check("union part.nef --list bars.txt", "part.nef");
  check("minkowski part.nef a#b.nef", "a#b.nef");
  // A folder of tiles is named, too.
  replace("part.nef", before);
  REQUIRE(here.run("nef", "convert part.nef -o part.tiles").code == 0);
  here.stop_at_output("union part.tiles --list bars.txt", "u.nef");
  replace("part.nef", after);
  REQUIRE(here.run("nef", "convert part.nef -o part.tiles").code == 0);
  REQUIRE(here.ranks(2, "union part.tiles --list bars.txt -o u.nef").code == 0);
  REQUIRE(here.ranks(1, "union part.nef --list bars.txt -o fresh.nef").code == 0);
  CHECK(here.read("u.nef") == here.read("fresh.nef"));
}

TEST_CASE("sums part by part are sums") {
  const Place here;
  static_cast<void>(here.run("nef", "eval 'sphere(3, 16) - box(0,0,0, 9,9,9) + segment(3,0,0, 5,0,0)' -o a.nef"));
  static_cast<void>(here.run("nef", "eval 'interior(box(0,0,0, 1,1,1)) + box(1,0,0, 3/2,1/2,1/2)' -o b.nef"));
  REQUIRE(here.run("minkowski", "a.nef b.nef -o plain.nef").code == 0);
  const Outcome run = here.ranks(2, "minkowski a.nef b.nef --part 20 -o sum.nef");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK(here.run("nef", "equal plain.nef sum.nef").code == 0);
}

TEST_CASE("offsets on ranks are those of minkowski, whatever their number") {
  const Place here;
  REQUIRE(here.run("nef", "eval 'regularize(sphere(3, 140) - box(0,0,0, 9,9,9))' -o a.nef").code == 0);
  for (const std::string offset : {"--offset 1/8,1", "--offset=-1/8,1 --inner"}) {
    CAPTURE(offset);
    REQUIRE(here.run("minkowski", "a.nef " + offset + " -o plain.nef").code == 0);
    for (const int ranks : {1, 3}) {
      const Outcome run = here.ranks(ranks, "minkowski a.nef " + offset + " -o sum.nef --times times.csv");
      CAPTURE(run.err, ranks);
      REQUIRE(run.code == 0);
      CHECK(here.run("nef", "equal plain.nef sum.nef").code == 0);
      const std::string times = here.read("times.csv");
      CHECK(std::count(times.begin(), times.end(), '\n') > 2);
    }
  }
  CHECK_THAT(here.ranks(2, "minkowski a.nef -o sum.nef").err, Contains("give two sets"));
  CHECK_THAT(here.ranks(2, "minkowski a.nef a.nef --offset 1 -o sum.nef").err, Contains("takes one set"));
  CHECK_THAT(here.ranks(2, "minkowski a.nef --offset 0 -o sum.nef").err, Contains("--offset 0"));
}

TEST_CASE("an output that cannot be written is refused before anything is computed, and no folder is made for it") {
  const Place here;
  REQUIRE(here.run("nef", "eval 'box(0,0,0, 1,1,1)' -o a.nef").code == 0);
  for (const std::string job : {"union a.nef a.nef", "minkowski a.nef a.nef", "minkowski a.nef --offset 1"}) {
    CAPTURE(job);
    const Outcome missing = here.ranks(1, job + " -o missing/sum.nef");
    CHECK(missing.code != 0);
    CHECK_THAT(missing.err, Contains("missing/sum.nef: cannot be written") && Contains("does its folder exist?"));
    CHECK_FALSE(fs::exists(here.path() / "missing"));
  }
  CHECK_THAT(here.ranks(1, "union a.nef a.nef -o sum.xyz").err, Contains("unknown extension"));
}

TEST_CASE("frames on ranks are those of visual_hull, and its manifest") {
  const Place here;
  const std::string elk = source_folder() + "/data/visual_hull/elk";
  for (const int k : {1, 2, 3}) {
    const fs::path folder = here.path() / ("frame_" + std::to_string(k));
    fs::create_directory(folder);
    for (const auto& entry : fs::directory_iterator(elk)) {
      if (entry.path().extension() == ".png") fs::copy_file(entry.path(), folder / entry.path().filename());
    }
  }
  const std::string options = elk + "/elk.json --simplify 2 --frames frame_%d/ -o ";
  REQUIRE(here.run("visual_hull", options + "plain_%d.off").code == 0);
  const Outcome run = here.ranks(2, "visual_hull " + options + "r_%d.off");
  CAPTURE(run.err, run.out);
  REQUIRE(run.code == 0);
  for (const std::string k : {"1", "2", "3"}) CHECK(here.read("plain_" + k + ".off") == here.read("r_" + k + ".off"));
  // Either program goes on where the other one stopped.
  fs::remove(here.path() / "r_2.off");
  CHECK_THAT(here.run("visual_hull", options + "r_%d.off").out, Contains("3 frames, 2 of them made before"));
  fs::remove(here.path() / "r_1.off");
  CHECK_THAT(here.ranks(2, "visual_hull " + options + "r_%d.off").out, Contains("3 frames, 2 of them made before"));
  CHECK(here.read("plain_1.off") == here.read("r_1.off"));
}

}  // namespace nef::test
