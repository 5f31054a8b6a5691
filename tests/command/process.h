// SPDX-License-Identifier: Apache-2.0
//
// Runs the program `nef` and looks at everything it leaves behind.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {

/// What a run of the program gave.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;

  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// A directory of its own for each test, removed at its end.
class Workplace : public nef::test::TemporaryFolder {
 public:
  [[nodiscard]] std::string operator/(const std::string& name) const { return path() / name; }

  /// Runs `nef ARGUMENTS` (quoted for the shell by the caller) in this directory.
  [[nodiscard]] Outcome nef(const std::string& arguments) const {
    const std::string command = "cd '" + path().string() + "' && '" + program_folder() + "/nef' " + arguments +
                                " > stdout.txt 2> stderr.txt < /dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.out = read("stdout.txt");
    outcome.err = read("stderr.txt");
    return outcome;
  }

  [[nodiscard]] std::string read(const std::string& name) const { return nef::test::slurp(file(name)); }
};

/// The bytes of an OFF file of a box.
inline std::string box_off(const std::array<int, 3>& low, const std::array<int, 3>& high) {
  std::ostringstream text;
  text << "OFF\n8 6 0\n";
  for (unsigned k = 0; k < 8; ++k) {
    for (unsigned i = 0; i < 3; ++i) text << ((k >> i & 1U) != 0 ? high[i] : low[i]) << (i < 2 ? ' ' : '\n');
  }
  text << "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  return text.str();
}

/// The same of [low, high]^3.
inline std::string cube_off(int low, int high) { return box_off({low, low, low}, {high, high, high}); }

/// One line that says something, exit code 2, nothing on stdout.
inline void check_refused(const Outcome& outcome, const std::string& words) {
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  REQUIRE(!outcome.err.empty());
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.back() == '\n');
  CHECK(outcome.err.rfind("nef: ", 0) == 0);
  CHECK(outcome.err.find(words) != std::string::npos);
}

}  // namespace nef::test
