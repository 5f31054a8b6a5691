// SPDX-License-Identifier: Apache-2.0
//
// The command as a user runs it.
#pragma once

#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

#include "tests/support/paths.h"

namespace nef::visual_hull::testing {

struct Outcome {
  int code = -1;
  std::string output;
};

/// Runs the command; `output` is standard output and standard error together.
inline Outcome run(const std::string& arguments) {
  const std::string command = program_folder() + "/visual_hull " + arguments + " 2>&1";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    outcome.output.append(buffer.data(), n);
  outcome.code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

}  // namespace nef::visual_hull::testing
