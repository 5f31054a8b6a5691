// SPDX-License-Identifier: Apache-2.0
//
// What the subcommands of `nef` share: flags, reading and writing with their times, output.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <iosfwd>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nef/command/progress_bar.h"
#include "nef/construct/construct.h"

namespace nef {

using Json = nlohmann::ordered_json;

/// Exit codes of the program.
enum ExitCode : int { kYes = 0, kNo = 1, kBad = 2 };

/// One run of the program.
class Session {
 public:
  Session(std::ostream& out, std::ostream& err) : out_(out), err_(err) {}

  // Set by the parser.
  bool json = false;
  bool quiet = false;
  bool exact = false;
  bool binary = false;
  bool no_check = false;
  MeshOptions mesh;
  std::string output;
  std::string input;                ///< of subcommands with one operand
  std::vector<std::string> inputs;  ///< of others
  int repeat = 1;
  unsigned threads = 0;  ///< 0: as many as the machine has

  int exit_code = kYes;
  double load_s = 0;
  double write_s = 0;
  Messages messages;  ///< notes about what was done to inputs and what an output does not hold

  /// Reads a set; its time is added to load_s, notes go to stderr unless quiet.
  Polyhedron load(const std::string& path);
  /// The same for many, several at once.
  std::vector<Polyhedron> load_all(const std::vector<std::string>& paths);
  /// Writes a set to `output`, if there is one.
  void store(const Polyhedron& set);

  /// Shows what is being done, to somebody at a terminal who wants to see it, until something else is printed.
  void show_phase(const std::string& phase, std::size_t done = 0, std::size_t total = 0);

  /// Prints a line for people; nothing if quiet or --json.
  void say(const std::string& line);
  /// Prints the one JSON object of a run, with the notes added.
  void print(Json object);
  /// Prints a line on stderr whatever the flags.
  void complain(const std::string& line);

 private:
  void show_messages(std::size_t first);

  std::ostream& out_;
  std::ostream& err_;
  std::unique_ptr<ProgressBar> bar_;  // made when first needed: the flags are known then
};

/// Seconds since its construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Adds a subcommand with the flags that all have (--json, --quiet, --threads).
CLI::App* add_subcommand(CLI::App& app, Session& session, const std::string& name, const std::string& description);
/// Flags about reading meshes: --strict, --as-surface, --no-check.
void add_input_flags(CLI::App* command, Session& session);
/// -o and flags about writing: --exact, --binary.
CLI::Option* add_output_flags(CLI::App* command, Session& session);

// One function for each file of subcommands.
void add_boolean_commands(CLI::App& app, Session& session);
void add_unary_commands(CLI::App& app, Session& session);
void add_transform_command(CLI::App& app, Session& session);
void add_info_commands(CLI::App& app, Session& session);
void add_check_command(CLI::App& app, Session& session);
void add_query_commands(CLI::App& app, Session& session);
void add_eval_command(CLI::App& app, Session& session);
void add_view_commands(CLI::App& app, Session& session);

}  // namespace nef
