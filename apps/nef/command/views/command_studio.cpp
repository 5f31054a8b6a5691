// SPDX-License-Identifier: Apache-2.0
//
// nef studio
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "apps/nef/command/commands.h"
#include "nef/base/error.h"

namespace nef {
namespace {

struct StudioFlags {
  std::vector<std::string> files;
  std::string root = ".";
  unsigned port = 0;
  unsigned seconds = 300;
  std::size_t megabytes = 4096;
  bool no_browser = false;
  bool run = false;
  std::string output;
};

void add_studio_options(CLI::App& command, Session&, StudioFlags& flags) {
  command
      .add_option(
          "files", flags.files,
          "Below the root: sets and meshes, a scene of the planner or of a hull, a .nefstudio file with the state")
      ->type_name("FILE");
  command.add_option("--root", flags.root, "The folder that the studio reads and writes, and no other (.)")
      ->type_name("FOLDER");
  command.add_option("--port", flags.port, "Of the server on this machine; 0 (default): any that is free")
      ->check(CLI::Range(0, 65535));
  command.add_flag("--no-browser", flags.no_browser, "Print the address only");
  command.add_option("--time", flags.seconds, "The most seconds that a computation takes (300)")
      ->check(CLI::Range(1, 1000000));
  command.add_option("--memory", flags.megabytes, "The most MiB of memory that computations take (4096)")
      ->check(CLI::Range(64, 100000000));
  command.add_flag("--run", flags.run, "Compute the .nefstudio file that is named, print the report, and end: no page");
  command.add_option("-o,--output", flags.output, "With --run: write the result to this file, in any format")
      ->type_name("FILE");
  command.footer(
      "Prints the address of a page, with a token that lets only this user in, and opens it in the browser. "
      "Everything\n"
      "stays on this machine. Ctrl+C ends it; what was typed is kept in the root, in studio.nefstudio.");
}

// Takes the place of this process, so that signals reach the server.
void run_studio(Session& session, const StudioFlags& flags) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "nef-studio";
  if (!flags.run && !flags.output.empty()) throw InputError("-o goes with --run; pages export by their own button");
  if (flags.run && flags.files.size() != 1) throw InputError("--run computes one .nefstudio file; name it");
  std::vector<std::string> words{program.string(),
                                 flags.root,
                                 std::to_string(flags.port),
                                 std::to_string(session.monitor.threads()),
                                 std::to_string(flags.seconds),
                                 std::to_string(flags.megabytes),
                                 flags.no_browser ? "0" : "1"};
  if (flags.run) {
    words = {program.string(),
             "--run",
             flags.output,
             flags.root,
             std::to_string(session.monitor.threads()),
             std::to_string(flags.seconds),
             std::to_string(flags.megabytes)};
  }
  words.insert(words.end(), flags.files.begin(), flags.files.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw UnsupportedError(errno == ENOENT ? "studio: it is not part of this build, which lacked cpp-httplib (Debian: "
                                           "libcpp-httplib-dev) or what the planner needs"
                                         : program.string() + ": " + std::strerror(errno));
}

}  // namespace

Commands studio_commands() {
  return {
      with_flags<StudioFlags>({.name = "studio",
                               .description = "Sets, sums, hulls and motions live in a browser, on this machine only",
                               .operands = "",
                               .reads_meshes = false},
                              add_studio_options, run_studio)};
}

}  // namespace nef
