// SPDX-License-Identifier: Apache-2.0
//
// The program `nef`: exact Boolean and topological operations on sets in files. All work is in the
// subcommands (command_*.cpp); here errors become one line on stderr and an exit code.
#include <iostream>
#include <new>

#include "nef/base/error.h"
#include "nef/command/session.h"

namespace {

int run(int argc, char** argv, nef::Session& session) {
  CLI::App app("Exact operations on Nef polyhedra: any sets of points bounded by planes.");
  app.name("nef");
  app.set_version_flag("--version", std::string("nef ") + NEF_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done or yes, 1 no (unequal, check failed), 2 bad input or usage.");
  nef::add_boolean_commands(app, session);
  nef::add_unary_commands(app, session);
  nef::add_transform_command(app, session);
  nef::add_info_commands(app, session);
  nef::add_check_command(app, session);
  nef::add_query_commands(app, session);
  nef::add_eval_command(app, session);
  nef::add_view_commands(app, session);
  const auto is_first = [argv](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_first).empty()) {
    session.complain("there is no subcommand '" + std::string(argv[1]) + "' (see nef --help)");
    return nef::kBad;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" with the code 0.
    if (error.get_exit_code() == 0) return app.exit(error, std::cout, std::cerr);
    std::string program = "nef";
    for (const CLI::App* command : app.get_subcommands()) program += " " + command->get_name();
    session.complain(std::string(error.what()) + " (see " + program + " --help)");
    return nef::kBad;
  }
  return session.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  nef::Session session(std::cout, std::cerr);
  try {
    const int code = run(argc, argv, session);
    std::cout.flush();
    if (!std::cout) {
      session.complain("stdout cannot be written to");
      return nef::kBad;
    }
    return code;
  } catch (const nef::Error& error) {
    session.complain(error.what());
  } catch (const std::bad_alloc&) {
    session.complain("out of memory");
  } catch (const std::exception& error) {
    // Broken invariants say so themselves.
    const std::string what = error.what();
    session.complain(what.rfind("internal error", 0) == 0 ? what : "internal error: " + what);
  }
  return nef::kBad;
}
