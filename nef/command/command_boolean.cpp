// SPDX-License-Identifier: Apache-2.0
//
// nef union | intersection | difference | symdiff
#include "nef/command/commands.h"

namespace nef {
namespace {

using Operation = Polyhedron (*)(std::span<const Polyhedron>, unsigned threads);

void add(CLI::App& app, Session& session, const std::string& name, const std::string& description, int most,
         Operation operation) {
  CLI::App* command = add_subcommand(app, session, name, description);
  command->add_option("inputs", session.inputs, "the operands, as files")->required()->expected(2, most);
  add_input_flags(command, session);
  add_output_flags(command, session);
  command->add_option("--repeat", session.repeat, "compute N times and report the median")
      ->check(CLI::Range(1, 1000000));
  command->callback([&session, name, operation] {
    const std::vector<Polyhedron> sets = session.load_all(session.inputs);
    finish(session, name, measure(session.repeat, [&] { return operation(sets, session.threads); }));
  });
}

}  // namespace

void add_boolean_commands(CLI::App& app, Session& session) {
  constexpr int kMany = CLI::detail::expected_max_vector_size;
  add(app, session, "union", "The points of any of the sets", kMany,
      [](std::span<const Polyhedron> s, unsigned n) { return s.size() == 2 ? unite(s[0], s[1]) : unite_all(s, n); });
  add(app, session, "intersection", "The points of all of the sets", kMany,
      [](std::span<const Polyhedron> s, unsigned n) {
        return s.size() == 2 ? intersect(s[0], s[1]) : intersect_all(s, n);
      });
  add(app, session, "difference", "The points of the first set that are not in the second", 2,
      [](std::span<const Polyhedron> s, unsigned) { return subtract(s[0], s[1]); });
  add(app, session, "symdiff", "The points of exactly one of two sets", 2,
      [](std::span<const Polyhedron> s, unsigned) { return symmetric_difference(s[0], s[1]); });
}

}  // namespace nef
