// SPDX-License-Identifier: Apache-2.0
//
// What is around a run: pipes and devices where files are expected, small stacks, names that look like options.
#include <sys/stat.h>

#include <algorithm>

#include "process.h"

namespace nef::test {
namespace {

using Catch::Contains;

// Like Workplace::nef, with shell commands in front; a run that never ends is ended.
Outcome limited(const Workplace& here, const std::string& limits, const std::string& arguments) {
  const std::string command = "cd '" + here.path().string() + "' && (" + limits + " timeout 60 '" + program_folder() +
                              "/nef' " + arguments + ") > stdout.txt 2> stderr.txt < /dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, here.read("stdout.txt"), here.read("stderr.txt")};
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

// apps/program/allocator/jemalloc_options.cpp
TEST_CASE("the program asks for large pages where it has jemalloc") {
  const Workplace here;
  const Outcome outcome = limited(here, "MALLOC_CONF=confirm_conf:true", "--version");
  CHECK(outcome.code == 0);
#ifdef NEF_WITH_JEMALLOC
  CHECK_THAT(outcome.err, Contains("-- Set conf value: thp:always"));
#else
  CHECK(outcome.err.empty());
#endif
}

TEST_CASE("pipes and devices are refused wherever a file is named") {
  const Workplace here;
  REQUIRE(mkfifo((here / "pipe.off").c_str(), 0600) == 0);
  here.write("a.off", box_off({0, 0, 0}, {1, 1, 1}));
  for (const std::string file : {"pipe.off", "/dev/zero"}) {
    here.write("import.csg", "group() { import(file = \"" + file + "\"); }");
    here.write("text.txt", "box(0,0,0, 1,1,1) + file(\"" + file + "\")");
    here.write("steps.txt", "+ file(\"" + file + "\")\n");
    for (const std::string& arguments :
         {"info " + file, "union a.off " + file, "check " + file, "repair " + file + " -o b.off",
          "view " + file + " -o a.html", "eval 'file(\"" + file + "\")'", "eval -f " + file,
          std::string("eval -f text.txt"), std::string("eval import.csg"),
          std::string("apply a.off --steps steps.txt -o b.nef"), "apply a.off --steps " + file + " -o b.nef"}) {
      const Outcome outcome = limited(here, "", arguments);
      CAPTURE(arguments, outcome.err);
      CHECK(outcome.code == 2);
      CHECK_THAT(outcome.err, Contains("is a device or a pipe"));
      CHECK(lines_of(outcome.err) == 1);
    }
  }
  CHECK_THAT(here.nef("--help").out, Contains("named") && Contains("pipes are refused"));
}

TEST_CASE("what stands behind -- is a file, whatever it looks like") {
  const Workplace here;
  REQUIRE(here.nef("eval 'box(0,0,0, 1,1,1)' -o ./-dash.nef").code == 0);
  CHECK(here.nef("info -- -dash.nef").code == 0);
  CHECK(here.nef("view -o a.html -- -dash.nef").code == 0);
  CHECK(here.nef("union -o b.nef -- -dash.nef -dash.nef").code == 0);
  const Outcome missing = here.nef("view -- -dash.nef");
  CHECK(missing.code == 2);
  CHECK_THAT(missing.err, Contains("--output is required"));
  CHECK_THAT(here.nef("view --nonsense -- -dash.nef").err, Contains("no option '--nonsense'"));
}

TEST_CASE("a small stack is made larger, or is an error of one line") {
  const Workplace here;
  const std::string deep = std::string(900, '(') + "box(0,0,0, 1,1,1)" + std::string(900, ')');
  here.write("deep.txt", deep);
  // A limit that may be raised.
  CHECK(limited(here, "ulimit -S -s 200;", "eval -f deep.txt").code == 0);
  // One that may not, unless by a superuser.
  const Outcome hard = limited(here, "ulimit -s 200;", "eval -f deep.txt");
  CAPTURE(hard.err);
  CHECK((hard.code == 0 || (hard.code == 2 && lines_of(hard.err) == 1)));
  if (hard.code != 0) CHECK_THAT(hard.err, Contains("ulimit -s"));
}

TEST_CASE("round shapes of more corners than memory holds are refused") {
  const Workplace here;
  CHECK_THAT(here.nef("eval 'sphere(1, 100000)'").err, Contains("3 to 4000"));
  here.write("ball.csg", "sphere($fn = 4000000, r = 1);");
  CHECK_THAT(here.nef("eval ball.csg").err, Contains("line 1: ") && Contains("corners around"));
}

}  // namespace nef::test
