// SPDX-License-Identifier: Apache-2.0
//
// nef complement | interior | closure | boundary | exterior | regularize
#include "apps/nef/command/commands.h"

namespace nef {
namespace {

using UnaryOperation = Polyhedron (*)(const Polyhedron&, const Monitor&);

Command unary(const std::string& name, const std::string& description, UnaryOperation operation) {
  Command row{.name = name, .description = description, .output = Output::kOptional, .repeats = true};
  row.run = [name, operation](Session& session) {
    const Polyhedron set = session.load(session.input);
    finish(session, name,
           measure(session.repeat, session.monitor, [&](const Monitor& monitor) { return operation(set, monitor); }));
  };
  return row;
}

}  // namespace

Commands unary_commands() {
  return {unary("complement", "The points that are not in the set",
                [](const Polyhedron& set, const Monitor&) { return complement(set); }),
          unary("interior", "The set without its boundary", interior),
          unary("closure", "The set with its boundary", closure),
          unary("boundary", "The topological boundary of the set", boundary),
          unary("exterior", "The interior of the complement", exterior),
          unary("regularize", "The closure of the interior", regularize)};
}

}  // namespace nef
