// SPDX-License-Identifier: Apache-2.0
#include "nef/command/run_command.h"

#include <iostream>

#include "nef/base/monitor.h"
#include "nef/command/commands.h"
#include "nef/program/run_program.h"

namespace nef {

CLI::App* add_subcommand(CLI::App& app, Session& session, const std::string& name, const std::string& description) {
  CLI::App* command = app.add_subcommand(name, description);
  add_run_flags(command, session);
  return command;
}

namespace {

void add_commands(CLI::App& app, Session& session, const CommandExtensions& extensions) {
  app.name("nef");
  app.set_version_flag("--version", std::string("nef ") + NEF_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done or yes, 1 no (unequal, check failed), 2 bad input or usage.");
  add_boolean_commands(app, session);
  add_unary_commands(app, session);
  add_transform_command(app, session);
  add_info_commands(app, session);
  add_check_command(app, session);
  add_repair_command(app, session);
  add_decimate_command(app, session);
  add_subdivide_command(app, session);
  add_query_commands(app, session);
  add_parts_commands(app, session);
  add_eval_command(app, session, extensions);
  add_apply_command(app, session, extensions);
  add_view_commands(app, session);
}

}  // namespace

int run_command(int argc, char** argv, const CommandExtensions& extensions) {
  Session session("nef", std::cout, std::cerr);
  CLI::App app("Exact operations on Nef polyhedra: any sets of points bounded by planes.");
  add_commands(app, session, extensions);
  const auto is_first = [argv](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_first).empty()) {
    session.complain("there is no subcommand '" + std::string(argv[1]) + "' (see nef --help)");
    return kBad;
  }
  const ProgressFunction show = [&session](const char* phase, std::size_t done, std::size_t total) {
    session.show_phase(phase, done, total);
  };
  session.monitor = Monitor().telling(show);
  return run_program(
      app, argc, argv, [&session] { return session.exit_code; },
      [&session](const std::string& line) { session.complain(line); });
}

}  // namespace nef
