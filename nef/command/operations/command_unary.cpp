// SPDX-License-Identifier: Apache-2.0
//
// nef complement | interior | closure | boundary | exterior | regularize
#include "nef/command/commands.h"

namespace nef {
namespace {

using UnaryOperation = Polyhedron (*)(const Polyhedron&, const Monitor&);

void add(CLI::App& app, Session& session, const std::string& name, const std::string& description,
         UnaryOperation operation) {
  CLI::App* command = add_subcommand(app, session, name, description);
  command->add_option("input", session.input, "The set, as a file")->required();
  add_input_flags(command, session);
  add_output_flags(command, session);
  command->add_option("--repeat", session.repeat, "Compute N times and report the median")
      ->check(CLI::Range(1, 1000000));
  command->callback([&session, name, operation] {
    const Polyhedron set = session.load(session.input);
    finish(session, name,
           measure(session.repeat, session.monitor, [&](const Monitor& monitor) { return operation(set, monitor); }));
  });
}

}  // namespace

void add_unary_commands(CLI::App& app, Session& session) {
  add(app, session, "complement", "The points that are not in the set",
      [](const Polyhedron& set, const Monitor&) { return complement(set); });
  add(app, session, "interior", "The set without its boundary", interior);
  add(app, session, "closure", "The set with its boundary", closure);
  add(app, session, "boundary", "The topological boundary of the set", boundary);
  add(app, session, "exterior", "The interior of the complement", exterior);
  add(app, session, "regularize", "The closure of the interior", regularize);
}

}  // namespace nef
