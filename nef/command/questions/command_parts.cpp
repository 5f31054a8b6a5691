// SPDX-License-Identifier: Apache-2.0
//
// nef section | split | distance
#include <filesystem>

#include "nef/base/timing/stopwatch.h"
#include "nef/command/commands.h"
#include "nef/command/questions/section_drawing.h"
#include "nef/distance/distance.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/number/brief_text.h"
#include "nef/parts/section.h"
#include "nef/parts/split.h"
#include "nef/program/numbers.h"

namespace nef {
namespace {

void write_section(Session& session, const Section& section, const Rational3& normal) {
  const std::string extension = lower_extension(session.output);
  if (extension == "svg") {
    write_file(session.output, section_svg(section, normal));
  } else if (extension == "dxf") {
    write_file(session.output, section_dxf(section, normal));
  } else {
    session.store(section.set);
    return;
  }
  if (section.unbounded > 0) {
    session.note(std::to_string(section.unbounded) + " parts of the section that reach infinity are not drawn");
  }
}

void add_section(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "section", "The exact intersection of a set and a plane");
  const auto plane = std::make_shared<std::string>();
  command->add_option("input", session.input, "The set, as a file")->required();
  command->add_option("--plane", *plane, "The plane ax+by+cz+d = 0")->required()->type_name("A,B,C,D");
  add_input_flags(command, session);
  add_output_flags(command, session)
      ->description(
          "file to write: a drawing in the plane (.svg in drawing units, .dxf), or the section in space (.nef and "
          "mesh formats)");
  command->callback([&session, plane] {
    const std::vector<Rational> n = parse_numbers(*plane, "--plane");
    if (n.size() != 4)
      throw InputError("--plane: expected four numbers a,b,c,d instead of " + std::to_string(n.size()));
    const Rational3 normal{n[0], n[1], n[2]};
    const Polyhedron set = session.load(session.input);
    const Stopwatch watch;
    const Section cut = section(set, normal, n[3], session.monitor);
    const double section_s = watch.seconds();
    if (!session.output.empty()) write_section(session, cut, normal);
    if (session.json) {
      session.spent("op", section_s);
      Json object;
      object["polygons"] = cut.polygons.size();
      object["segments"] = cut.segments.size();
      object["points"] = cut.points.size();
      object["unbounded"] = cut.unbounded;
      object["area"] = section_area(cut);
      return session.print("section", object);
    }
    session.say(std::to_string(cut.polygons.size()) + " polygons, " + std::to_string(cut.segments.size()) +
                " segments, " + std::to_string(cut.points.size()) + " points; area " + Json(section_area(cut)).dump());
  });
}

void add_split(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "split", "Write one file for each part of a set");
  struct Flags {
    bool volumes = false;
  };
  const auto flags = std::make_shared<Flags>();
  command->add_option("input", session.input, "The set, as a file")->required();
  command->add_flag("--volumes", flags->volumes,
                    "One part for each volume instead of each connected component: what touches in edges comes apart");
  add_input_flags(command, session);
  add_output_flags(command, session)
      ->required()
      ->description("folder for the parts, made if need be; they are called 0.off, 1.off, ... (see --format)");
  command->callback([&session, flags] {
    const Polyhedron set = session.load(session.input);
    const Stopwatch watch;
    const std::vector<Polyhedron> parts =
        flags->volumes ? split_volumes(set, session.monitor) : split(set, session.monitor);
    const double split_s = watch.seconds();
    const std::filesystem::path folder = session.output;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw InputError(session.output + ": cannot be made a folder (" + error.message() + ")");
    if (session.format.empty()) session.format = "off";
    Json files = Json::array();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      session.output = (folder / (std::to_string(i) + "." + session.format)).string();
      session.store(parts[i]);
      files.push_back(session.output);
      session.say(session.output + ": " + summary(parts[i]));
    }
    if (session.json) {
      session.spent("op", split_s);
      session.print("split", {{"files", std::move(files)}});
    }
  });
}

void add_distance(CLI::App& app, Session& session) {
  CLI::App* command =
      add_subcommand(app, session, "distance", "How far apart are two sets? The exact square, and nearest points");
  command->add_option("inputs", session.inputs, "The two sets, as files")->required()->expected(2);
  add_input_flags(command, session);
  command->callback([&session] {
    const Polyhedron a = session.load(session.inputs[0]);
    const Polyhedron b = session.load(session.inputs[1]);
    const Stopwatch watch;
    const std::optional<Distance> found = distance(a, b, session.monitor);
    if (!found) throw InputError("one of the sets is empty: there is no distance");
    if (session.json) {
      session.spent("op", watch.seconds());
      return session.print("distance", {{"contact", contact_name(found->contact)},
                                        {"common_point", found->common_point},
                                        {"squared", to_string(found->squared)},
                                        {"distance", found->value()},
                                        {"on_a", point_json(found->on_a)},
                                        {"on_b", point_json(found->on_b)}});
    }
    session.say(std::string(contact_name(found->contact)) +
                (found->contact == Contact::kTouching && !found->common_point ? ", without a common point" : ""));
    if (found->contact == Contact::kOverlapping) return;
    if (found->contact == Contact::kDisjoint) {
      session.say("distance: " + Json(found->value()).dump() + ", the square root of " + brief_text(found->squared));
      session.say("nearest: " + point_text(found->on_a) + " and " + point_text(found->on_b));
    } else {
      session.say("at: " + point_text(found->on_a));
    }
  });
}

}  // namespace

void add_parts_commands(CLI::App& app, Session& session) {
  add_section(app, session);
  add_split(app, session);
  add_distance(app, session);
}

}  // namespace nef
