// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `nef`: a table whose rows stand beside the functions that do the work, a list for each file of
// them. A new subcommand is a row in such a list.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/nef/command/run_command.h"
#include "apps/program/expression/expression.h"
#include "apps/program/reports/report.h"
#include "apps/program/session.h"

namespace nef {

/// What a subcommand does with -o and the options about writing.
enum class Output { kNone, kOptional, kRequired };

/// A subcommand. All have the flags of all programs, too.
struct Command {
  std::string name;
  std::string description;
  /// What its operands are, files that go to Session::input (if it has just one) or Session::inputs; empty: none.
  std::string operands = "File of the set";
  int least = 1;
  int most = 1;
  bool reads_meshes = true;  ///< options about reading meshes
  Output output = Output::kNone;
  std::string output_text = {};  ///< what -o is, where it is not a file for a set
  bool repeats = false;          ///< --repeat
  /// Adds the options that it has alone, and what else its help says.
  std::function<void(CLI::App& command, Session& session)> add_options = {};
  std::function<void(Session& session)> run = {};
};
using Commands = std::vector<Command>;

/// As many operands as one likes.
inline constexpr int kAnyNumber = CLI::detail::expected_max_vector_size;

/// A row whose options are bound to `Flags` by add(command, session, flags), and used by run(session, flags).
template <typename Flags, typename Add, typename Run>
Command with_flags(Command row, const Add& add, const Run& run) {
  const auto flags = std::make_shared<Flags>();
  row.add_options = [flags, add](CLI::App& command, Session& session) { add(command, session, *flags); };
  row.run = [flags, run](Session& session) { run(session, *flags); };
  return row;
}

/// How expressions are computed by a subcommand; names of files are relative to `folder`.
ExpressionOptions expression_options(Session& session, const CommandExtensions& extensions,
                                     const std::filesystem::path& folder = {});

Commands boolean_commands();
Commands unary_commands();
Commands transform_commands();
Commands info_commands();
Commands check_commands();
Commands mesh_commands();
Commands repair_commands();
Commands query_commands();
Commands parts_commands();
Commands eval_commands(const CommandExtensions& extensions);
Commands apply_commands(const CommandExtensions& extensions);
Commands view_commands();
Commands studio_commands();

}  // namespace nef
