// SPDX-License-Identifier: Apache-2.0
//
// nef section | split | distance
//
// Each command reads its sets, calls one function of nef/parts or nef/distance, which says how it works, and prints
// what that found; split chooses parts by their volumes before it writes them.
#include <filesystem>
#include <system_error>

#include "apps/nef/command/commands.h"
#include "apps/program/numbers.h"
#include "apps/view/section_drawing.h"
#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/distance/distance.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/number/brief_text.h"
#include "nef/parts/by_volume.h"
#include "nef/parts/section.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

void write_section(Session& session, const Section& section, const Rational3& normal) {
  const std::string extension = lower_extension(session.output);
  if (extension == "svg") {
    write_file(session.output, view::section_svg(section, normal));
  } else if (extension == "dxf") {
    write_file(session.output, view::section_dxf(section, normal));
  } else {
    session.store(section.set);
    return;
  }
  if (section.unbounded > 0) {
    session.note(std::to_string(section.unbounded) + " unbounded parts of the section are not drawn");
  }
}

void run_section(Session& session, const std::string& plane) {
  const std::array<Rational, 4> n = parse_plane(plane, "--plane");
  session.require_output({"svg", "dxf"});
  const Rational3 normal{n[0], n[1], n[2]};
  const Polyhedron set = session.load(session.input);
  const Stopwatch watch;
  const Section cut = section(set, normal, n[3], session.monitor);
  const double section_s = watch.seconds();
  if (!session.output.empty()) write_section(session, cut, normal);
  if (cut.set.is_empty()) session.note("the plane does not meet the set");
  if (session.json) {
    session.spent("op", section_s);
    Json object;
    object["polygons"] = cut.polygons.size();
    object["segments"] = cut.segments.size();
    object["points"] = cut.points.size();
    object["unbounded"] = cut.unbounded;
    object["area"] = view::section_area(cut);
    return session.print("section", object);
  }
  session.say(counted(cut.polygons.size(), "polygon", "polygons") + ", " +
              counted(cut.segments.size(), "segment", "segments") + ", " +
              counted(cut.points.size(), "point", "points") + "; area " + Json(view::section_area(cut)).dump());
}

std::string left_out_text(std::size_t left_out, std::size_t all) {
  return std::to_string(left_out) + " of " + std::to_string(all) + " parts " + (left_out == 1 ? "is" : "are") +
         " left out";
}

// Whether the output names a file of a format that is written, and no folder.
bool names_file(const std::string& path) {
  std::error_code unknown;
  return is_file_extension(lower_extension(path)) && !std::filesystem::is_directory(path, unknown);
}

void store_as_one(Session& session, const std::vector<Polyhedron>& parts, double seconds) {
  if (parts.empty()) throw InputError("there is no part to write");
  const Polyhedron set = parts.size() == 1 ? parts[0] : unite_all(parts, session.monitor);
  session.store(set);
  session.say(session.output + ": " + summary(set));
  if (!session.json) return;
  session.spent("op", seconds);
  session.print("split", {{"files", Json::array({session.output})}});
}

struct SplitFlags {
  bool volumes = false;
  bool largest = false;
  std::string above;
};

void add_split_options(CLI::App& command, Session&, SplitFlags& flags) {
  command.add_flag("--volumes", flags.volumes,
                   "One part per volume instead of per connected component: volumes that touch in edges are separated");
  command
      .add_option(
          "--above", flags.above,
          "Only parts of more than this volume; if -o names a file (B.off) instead of a folder, it gets all of them")
      ->type_name("VOLUME");
  command.add_flag("--largest", flags.largest, "Only the part of the largest volume; -o names its file");
}

void run_split(Session& session, const SplitFlags& flags) {
  if (flags.largest) session.require_output();
  const Polyhedron set = session.load(session.input);
  const Stopwatch watch;
  std::vector<Polyhedron> parts = flags.volumes ? split_volumes(set, session.monitor) : split(set, session.monitor);
  const std::size_t all = parts.size();
  if (!flags.above.empty()) {
    const std::vector<Rational> bound = parse_numbers(flags.above, 1, "--above");
    parts = pieces_above(std::move(parts), bound[0], session.monitor);
  }
  if (flags.largest && !parts.empty()) parts = {parts[largest_piece(parts, session.monitor)]};
  const double split_s = watch.seconds();
  if (parts.size() < all) session.note(left_out_text(all - parts.size(), all));
  if (flags.largest || (!flags.above.empty() && names_file(session.output))) {
    return store_as_one(session, parts, split_s);
  }
  const std::filesystem::path folder = session.output;
  make_folder(session.output);
  if (session.format.empty()) session.format = "off";
  Json files = Json::array();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    session.output = (folder / (std::to_string(i) + "." + session.format)).string();
    session.store(parts[i]);
    files.push_back(session.output);
    session.say(session.output + ": " + summary(parts[i]));
  }
  if (!session.json) return;
  session.spent("op", split_s);
  session.print("split", {{"files", std::move(files)}});
}

void run_distance(Session& session) {
  const Polyhedron a = session.load(session.inputs[0]);
  const Polyhedron b = session.load(session.inputs[1]);
  const Stopwatch watch;
  const std::optional<Distance> found = distance(a, b, session.monitor);
  if (!found) throw InputError("one of the sets is empty, so there is no distance");
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
}

}  // namespace

Commands parts_commands() {
  return {
      with_flags<std::string>(
          {.name = "section",
           .description = "Intersect a set with a plane",
           .output = Output::kOptional,
           .output_text = "Output file: a drawing in the plane (.svg, one unit is 1 mm, or .dxf), or the section in "
                          "space (.nef and mesh formats)"},
          [](CLI::App& command, Session&, std::string& plane) {
            command.add_option("--plane", plane, "The plane ax+by+cz+d = 0")->required()->type_name("A,B,C,D");
          },
          run_section),
      with_flags<SplitFlags>(
          {.name = "split",
           .description = "Write one file for each part of a set",
           .output = Output::kRequired,
           .output_text = "Folder for the parts, created if missing; their files are 0.off, 1.off, ... (see --format)"},
          add_split_options, run_split),
      {.name = "distance",
       .description = "The distance of two sets: its exact square, and nearest points",
       .operands = "Files of the two sets",
       .least = 2,
       .most = 2,
       .run = run_distance}};
}

}  // namespace nef
