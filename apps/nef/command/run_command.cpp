// SPDX-License-Identifier: Apache-2.0
#include "apps/nef/command/run_command.h"

#include <iostream>

#include "apps/nef/command/commands.h"
#include "apps/program/run_program.h"
#include "apps/program/version.h"
#include "nef/base/monitor.h"

namespace nef {
namespace {

void add(CLI::App& app, Session& session, const Command& row) {
  CLI::App* command = app.add_subcommand(row.name, row.description);
  add_run_flags(command, session);
  if (!row.operands.empty() && row.most == 1) {
    command->add_option("input", session.input, row.operands)->required();
  } else if (!row.operands.empty()) {
    command->add_option("inputs", session.inputs, row.operands)->required()->expected(row.least, row.most);
  }
  if (row.repeats) {
    command->add_option("--repeat", session.repeat, "Compute N times and report the median")
        ->check(CLI::Range(1, 1000000));
  }
  if (row.add_options) row.add_options(*command, session);
  if (row.reads_meshes) add_input_flags(command, session);
  if (row.output != Output::kNone) {
    CLI::Option* output = add_output_flags(command, session)->required(row.output == Output::kRequired);
    if (!row.output_text.empty()) output->description(row.output_text);
  }
  const bool writes_set = row.output != Output::kNone && row.output_text.empty();
  command->callback([&session, run = row.run, writes_set] {
    if (writes_set) session.require_output();
    run(session);
  });
}

void add_commands(CLI::App& app, Session& session, const CommandExtensions& extensions) {
  app.name("nef");
  app.set_version_flag("--version", version_text("nef"));
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done or yes, 1 no (unequal, check failed), 2 bad input or usage.");
  for (const Commands& rows :
       {boolean_commands(), unary_commands(), transform_commands(), info_commands(), check_commands(),
        repair_commands(), mesh_commands(), query_commands(), parts_commands(), eval_commands(extensions),
        apply_commands(extensions), view_commands(), studio_commands()}) {
    for (const Command& row : rows) add(app, session, row);
  }
}

}  // namespace

ExpressionOptions expression_options(Session& session, const CommandExtensions& extensions,
                                     const std::filesystem::path& folder) {
  ExpressionOptions options;
  options.load = [&session, folder](const std::string& file, const Monitor& monitor) {
    return session.load((folder / file).string(), monitor);
  };
  options.minkowski = extensions.minkowski;
  options.ball = extensions.ball;
  options.hull = extensions.hull;
  options.monitor = session.monitor;
  return options;
}

int run_command(int argc, char** argv, const CommandExtensions& extensions) {
  Session session("nef", std::cout, std::cerr);
  CLI::App app("Exact operations on Nef polyhedra: any sets of points bounded by planes.");
  add_commands(app, session, extensions);
  const ProgressFunction show = [&session](const char* phase, std::size_t done, std::size_t total) {
    session.show_phase(phase, done, total);
  };
  session.monitor = session.monitor.telling(show);
  return run_program(
      app, argc, argv, [&session] { return session.exit_code; },
      [&session](const std::string& line) { session.complain(line); });
}

}  // namespace nef
