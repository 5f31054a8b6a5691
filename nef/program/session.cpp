// SPDX-License-Identifier: Apache-2.0
//
// Each function does one thing that all commands do alike: it shows a phase, times the call, collects its messages, and
// prints those that are new. Reports of --json get the same phases and messages.
#include "nef/program/session.h"

#include <atomic>
#include <ostream>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/geometry/vectors.h"
#include "nef/io/polyhedron_file.h"
#include "nef/program/common_options.h"
#include "nef/program/run_program.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef {
Polyhedron Session::load(const std::string& path) { return load(path, monitor); }

Polyhedron Session::load(const std::string& path, const Monitor& monitor) { return load_all({path}, monitor).front(); }

std::vector<Polyhedron> Session::load_all(const std::vector<std::string>& paths) { return load_all(paths, monitor); }

std::vector<Polyhedron> Session::load_all(const std::vector<std::string>& paths, const Monitor& monitor) {
  const Stopwatch watch;
  const std::size_t first = messages.size();
  std::vector<Polyhedron> sets(paths.size());
  std::vector<Messages> notes(paths.size());
  std::atomic<std::size_t> done = 0;
  show_phase("reading", 0, paths.size());
  parallel_for(paths.size(), threads, monitor, [&](std::size_t i, const Monitor& own) {
    MeshOptions options = mesh;
    options.threads = threads;
    options.monitor = own;
    sets[i] = read_file_or_tiles(paths[i], options, &notes[i]);
    show_phase("reading", ++done, paths.size());
  });
  for (const Messages& some : notes) messages.insert(messages.end(), some.begin(), some.end());
  load_s_ += watch.seconds();
  show_messages(first);
  show_phase("computing");
  return sets;
}

void Session::store(const Polyhedron& set) {
  if (output.empty()) return;
  if (output == "-" && json) throw InputError("--json and -o - both want standard output; name a file");
  show_phase("writing " + output);
  const Stopwatch watch;
  const std::size_t first = messages.size();
  WrittenFile written;
  if (names_tile_folder(output)) {
    if (set.complex().label_count > 2) messages.emplace_back("tiles hold a set: all marks but 0 have become 1");
    const Tiling tiling{.limit = kVerticesOfTileInFile, .threads = threads};
    write_tiles(output, TiledPolyhedron(set, tiling, monitor));
  } else {
    written = write_polyhedron(output, set, write_options(), &messages);
  }
  write_s_ += watch.seconds();
  show_messages(first);
  tell_written(written);
}

void Session::store_mesh(Mesh surface, bool is_strict) {
  if (output == "-" && json) throw InputError("--json and -o - both want standard output; name a file");
  show_phase("writing " + output);
  const Stopwatch watch;
  const std::size_t first = messages.size();
  const WrittenFile written = write_solid_mesh(output, std::move(surface), is_strict, write_options(), &messages);
  write_s_ += watch.seconds();
  show_messages(first);
  tell_written(written);
}

// What is wrong with a file is told to those who want to be told of nothing else, too.
void Session::tell_written(const WrittenFile& written) {
  if (!written.problem.empty()) {
    messages.push_back(written.problem);
    complain("warning: " + written.problem);
  }
  offset_ = written.offset;
  if (!is_zero(offset_)) note(offset_note(output, offset_));
}

std::map<std::string, std::size_t> Session::store_groups(const Polyhedron& labeled, const BoundaryGroups& groups) {
  if (output == "-" && json) throw InputError("--json and -o - both want standard output; name a file");
  show_phase("writing " + output);
  const Stopwatch watch;
  const std::size_t first = messages.size();
  WrittenFile written;
  std::map<std::string, std::size_t> faces =
      write_groups(output, labeled, groups, write_options(), &messages, &written);
  write_s_ += watch.seconds();
  show_messages(first);
  tell_written(written);
  return faces;
}

PolyhedronWriteOptions Session::write_options() const {
  PolyhedronWriteOptions options;
  options.exact = exact;
  options.binary = binary;
  options.text = text;
  options.polygons = polygons;
  options.manifold = mesh_file.manifold;
  options.lenient = mesh_file.lenient;
  options.recenter = mesh_file.recenter;
  options.threads = threads;
  options.monitor = monitor;
  options.format = output == "-" && format.empty() ? "nef" : format;
  return options;
}

MeshWriteOptions Session::mesh_write_options() const {
  return {.exact = exact, .binary = binary, .format = format, .monitor = monitor};
}

void Session::show_phase(const std::string& phase, std::size_t done, std::size_t total) {
  if (!bar_) bar_ = std::make_unique<ProgressBar>(!quiet);
  bar_->show(phase, done, total);
}

void Session::note(const std::string& text) { note_all({text}); }

void Session::note_all(const Messages& notes) {
  const std::size_t first = messages.size();
  messages.insert(messages.end(), notes.begin(), notes.end());
  show_messages(first);
}

void Session::say(const std::string& line) {
  if (bar_) bar_->clear();
  if (!quiet && !json && output != "-") out_ << one_line(line) << '\n';
}

void Session::spent(const std::string& phase, double seconds, std::optional<PredicateCounts> predicates) {
  phases_.push_back({phase, seconds, predicates});
}

void Session::print(const std::string& command, const Json& found) {
  if (bar_) bar_->clear();
  std::vector<ReportPhase> phases{{"load", load_s_, {}}};
  phases.insert(phases.end(), phases_.begin(), phases_.end());
  if (!output.empty()) phases.push_back({"write", write_s_, {}});
  Json with_offset = found;
  if (!is_zero(offset_)) {
    with_offset["offset"] = Json::array({to_string(offset_[0]), to_string(offset_[1]), to_string(offset_[2])});
  }
  out_ << report_text(run_report(command, with_offset, phases, messages));
}

void Session::complain(const std::string& line) {
  if (bar_) bar_->clear();
  err_ << program_ << ": " << one_line(line) << '\n';
}

void Session::show_messages(std::size_t first) {
  if (quiet) return;
  for (const std::string& line : printed_notes(std::span(messages).subspan(first))) complain(line);
}

void add_run_flags(CLI::App* command, Session& session) {
  add_run_options(*command, session.json, session.quiet, session.threads);
}

void add_input_flags(CLI::App* command, Session& session) {
  add_mesh_input_options(*command, session.mesh.strict, session.mesh.as_surface);
  command->add_flag(
      "--no-check", session.no_check,
      "Taken for the sake of old scripts: meshes are always checked, which is a fourth of the time of reading them");
}

CLI::Option* add_output_flags(CLI::App* command, Session& session) {
  add_file_output_options(*command, session.exact, session.binary, session.text);
  add_manifold_option(*command, session.mesh_file.manifold);
  add_mesh_file_options(*command, session.mesh_file);
  command->add_flag("--polygons", session.polygons,
                    "Write faces that are not convex as polygons, too, instead of cutting them into triangles");
  command->add_option("--format", session.format, "Format to write, whatever the name of the file; nef for -o -")
      ->check(CLI::IsMember({"nef", "nef3", "off", "obj", "stl", "ply", "glb", "3mf"}));
  return command
      ->add_option(
          "-o,--output", session.output,
          "File to write, - for standard output; its extension (nef, nef3, off, obj, stl, ply, glb, 3mf) picks the "
          "format")
      ->check([](const std::string& path) { return std::string(path.empty() ? "the name of the file is empty" : ""); });
}

}  // namespace nef
