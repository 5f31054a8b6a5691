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
  load_s_ += watch.seconds();
  Messages all;
  for (const Messages& some : notes) all.insert(all.end(), some.begin(), some.end());
  note_all(all);
  show_phase("computing");
  return sets;
}

void Session::write_timed(const std::function<WrittenFile(Messages& notes)>& write) {
  if (output == "-" && json) throw InputError("--json and -o - both want standard output; name a file");
  show_phase("writing " + output);
  const Stopwatch watch;
  Messages notes;
  const WrittenFile written = write(notes);
  write_s_ += watch.seconds();
  note_all(notes);
  if (bar_) bar_->clear();
  notes_.wrote(output, written);
}

void Session::store(const Polyhedron& set) {
  if (output.empty()) return;
  write_timed([&](Messages& notes) -> WrittenFile {
    if (!names_tile_folder(output)) return write_polyhedron(output, set, write_options(), &notes);
    require_no_mesh_flags(output, mesh_file);
    if (set.complex().label_count > 2) notes.emplace_back("tiles hold a set: all marks but 0 have become 1");
    const Tiling tiling{.limit = kVerticesOfTileInFile, .threads = threads};
    write_tiles(output, TiledPolyhedron(set, tiling, monitor));
    return {};
  });
}

void Session::store_mesh(Mesh surface, bool is_strict) {
  write_timed([&](Messages& notes) {
    return write_solid_mesh(output, std::move(surface), is_strict, write_options(), &notes);
  });
}

std::map<std::string, std::size_t> Session::store_groups(const Polyhedron& labeled, const BoundaryGroups& groups) {
  std::map<std::string, std::size_t> faces;
  write_timed([&](Messages& notes) {
    WrittenFile written;
    faces = write_groups(output, labeled, groups, write_options(), &notes, &written);
    return written;
  });
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

void Session::show_phase(const std::string& phase, std::size_t done, std::size_t total) {
  if (!bar_) bar_ = std::make_unique<ProgressBar>(!quiet);
  bar_->show(phase, done, total);
}

void Session::note(const std::string& text) { note_all({text}); }

void Session::note_all(const Messages& notes) {
  if (bar_ && !notes.empty()) bar_->clear();
  notes_.note(notes);
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
  Json all = found;
  notes_.add_offsets(all);
  out_ << report_text(run_report(command, all, phases, notes()));
}

void Session::complain(const std::string& line) {
  if (bar_) bar_->clear();
  err_ << program_ << ": " << one_line(line) << '\n';
}

void add_run_flags(CLI::App* command, Session& session) {
  add_run_options(*command, session.json, session.quiet, session.threads);
}

void add_input_flags(CLI::App* command, Session& session) {
  add_mesh_input_options(*command, session.mesh);
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
