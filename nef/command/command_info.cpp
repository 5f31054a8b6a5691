// SPDX-License-Identifier: Apache-2.0
//
// nef info | convert | equal
#include "nef/command/commands.h"

namespace nef {
namespace {

void print_info(Session& session, const Json& info) {
  for (const auto& [key, value] : info.items()) {
    session.say(key + ": " + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
}

void add_info(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "info", "Counts, properties and exact measures of a set");
  command->add_option("input", session.input, "the set, as a file")->required();
  add_input_flags(command, session);
  command->callback([&session] {
    Json info = info_json(session.load(session.input));
    if (session.json) {
      session.print(std::move(info));
    } else {
      print_info(session, info);
    }
  });
}

void add_convert(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "convert", "Read a set and write it in another format");
  command->add_option("input", session.input, "the set, as a file")->required();
  add_input_flags(command, session);
  add_output_flags(command, session)->required();
  command->callback([&session] {
    const Polyhedron set = session.load(session.input);
    session.store(set);
    if (!session.json) return session.say(summary(set));
    Json object;
    object["command"] = "convert";
    object["load_s"] = session.load_s;
    object["write_s"] = session.write_s;
    object["result"] = info_json(set);
    session.print(std::move(object));
  });
}

void add_equal(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "equal", "Are two sets the same? Exit code 0 if they are, 1 if not");
  command->add_option("inputs", session.inputs, "the two sets, as files")->required()->expected(2);
  add_input_flags(command, session);
  command->callback([&session] {
    const Polyhedron a = session.load(session.inputs[0]);
    const Polyhedron b = session.load(session.inputs[1]);
    const bool same = equal(a, b);
    session.exit_code = same ? kYes : kNo;
    if (session.json) {
      session.print({{"equal", same}});
    } else {
      session.say(same ? "equal" : "different");
    }
  });
}

}  // namespace

void add_info_commands(CLI::App& app, Session& session) {
  add_info(app, session);
  add_convert(app, session);
  add_equal(app, session);
}

}  // namespace nef
