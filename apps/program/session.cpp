// SPDX-License-Identifier: Apache-2.0
//
// Each function does one thing that all commands do alike: it shows a phase, times the call, collects its messages, and
// prints those that are new. Reports of --json get the same phases and messages.
#include "apps/program/session.h"

#include <algorithm>
#include <atomic>
#include <ostream>

#include "apps/program/common_options.h"
#include "apps/program/run_program.h"
#include "nef/base/error.h"
#include "nef/base/text/word_list.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/io/output_path.h"
#include "nef/io/polyhedron_file.h"
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
  parallel_for(paths.size(), monitor, [&](std::size_t i, const Monitor& own) {
    MeshOptions options = mesh;
    options.monitor = own.on_threads(monitor.threads());  // each file may be large
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

Polyhedron Session::solid_of(const Mesh& mesh_of_part, const std::string& name) {
  Messages notes;
  MeshOptions options = mesh;
  options.monitor = monitor;
  try {
    Polyhedron set = from_mesh(mesh_of_part, options, &notes);
    for (std::string& note : notes) note = name + ": " + note;
    note_all(notes);
    return set;
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

void Session::write(const std::string& path, const std::function<WrittenFile(Messages& notes)>& write) {
  if (path == "-" && json) throw InputError("--json and -o - both write to standard output; name a file with -o");
  show_phase("writing " + path);
  const Stopwatch watch;
  Messages notes;
  const WrittenFile written = write(notes);
  write_s_ += watch.seconds();
  note_all(notes);
  hide_phase();
  notes_.wrote(path, written);
}

void Session::require_output(const std::vector<std::string>& others) const {
  if (output.empty() || output == "-" || names_tile_folder(output)) return;
  const std::string extension = lower_extension(output);
  const bool known = is_file_extension(extension) || std::find(others.begin(), others.end(), extension) != others.end();
  if (format.empty() && !known) throw unknown_extension(output, others);
  require_folder_of(output);
}

void Session::store(const Polyhedron& set) {
  if (!output.empty()) store_at(output, set, write_options());
}

void Session::store_at(const std::string& path, const Polyhedron& set, const PolyhedronWriteOptions& options) {
  write(path, [&](Messages& notes) -> WrittenFile {
    if (!names_tile_folder(path)) return write_polyhedron(path, set, options, &notes);
    require_no_mesh_flags(path, {.manifold = options.manifold, .recenter = options.recenter});
    if (set.complex().label_count > 2)
      notes.emplace_back("tiles store two marks only: all marks other than 0 were written as 1");
    const Tiling tiling{.limit = kVerticesOfTileInFile};
    write_tiles(path, TiledPolyhedron(set, tiling, monitor));
    return {};
  });
}

void Session::store_mesh(Mesh surface, bool is_strict) {
  write(output, [&](Messages& notes) {
    return write_solid_mesh(output, std::move(surface), is_strict, write_options(), &notes);
  });
}

std::map<std::string, std::size_t> Session::store_groups(const Polyhedron& labeled, const BoundaryGroups& groups) {
  std::map<std::string, std::size_t> faces;
  write(output, [&](Messages& notes) {
    WrittenFile written;
    faces = write_groups(output, labeled, groups, write_options(), &notes, &written);
    return written;
  });
  return faces;
}

PolyhedronWriteOptions Session::write_options(const std::string& path) const {
  PolyhedronWriteOptions options;
  options.exact = exact;
  options.binary = binary;
  options.text = text;
  options.polygons = polygons;
  options.manifold = mesh_file.manifold;
  options.lenient = mesh_file.lenient;
  options.recenter = mesh_file.recenter;
  options.monitor = monitor;
  options.format = path == "-" && format.empty() ? "nef" : format;
  return options;
}

void Session::show_phase(const std::string& phase, std::size_t done, std::size_t total) {
  if (!bar_) bar_ = std::make_unique<ProgressBar>(!quiet);
  bar_->show(phase, done, total);
}

void Session::hide_phase() {
  if (bar_) bar_->clear();
}

void Session::note(const std::string& text) { note_all({text}); }

void Session::note_all(const Messages& notes) {
  if (bar_ && !notes.empty()) bar_->clear();
  notes_.note(notes);
}

void Session::say(const std::string& line) {
  hide_phase();
  if (!quiet && !json && output != "-") (report == "-" ? err_ : out_) << one_line(line) << '\n';
}

void Session::spent(const std::string& phase, double seconds, std::optional<PredicateCounts> predicates) {
  phases_.push_back({phase, seconds, predicates});
}

void Session::print(const std::string& command, const Json& found) {
  hide_phase();
  const auto told = [this](const std::string& phase) {
    return std::any_of(phases_.begin(), phases_.end(), [&](const ReportPhase& p) { return p.name == phase; });
  };
  std::vector<ReportPhase> phases;
  if (!told("load")) phases.push_back({"load", load_s_, {}});
  phases.insert(phases.end(), phases_.begin(), phases_.end());
  if (!output.empty() && !told("write")) phases.push_back({"write", write_s_, {}});
  Json all = found;
  notes_.add_offsets(all);
  const std::string text = report_text(run_report(command, all, phases, notes()));
  if (json || report.empty() || report == "-") out_ << text;
  if (!report.empty() && report != "-") write_file(report, text);
}

void Session::complain(const std::string& line) {
  hide_phase();
  err_ << program_ << ": " << one_line(line) << '\n';
}

void add_run_flags(CLI::App* command, Session& session) {
  add_run_options(*command, session.json, session.quiet, session.monitor);
}

void add_input_flags(CLI::App* command, Session& session) { add_mesh_input_options(*command, session.mesh); }

CLI::Option* add_output_flags(CLI::App* command, Session& session) {
  add_file_output_options(*command, session.exact, session.binary, session.text);
  add_manifold_option(*command, session.mesh_file.manifold);
  add_mesh_file_options(*command, session.mesh_file);
  command->add_flag("--polygons", session.polygons,
                    "Write faces that have more than four corners or are not convex as polygons instead of triangles");
  command->add_option("--format", session.format, "Output format, whatever the file name; nef for -o -")
      ->check(CLI::IsMember(file_extensions()));
  return command
      ->add_option("-o,--output", session.output,
                   "Output file, or - for standard output; its extension (" + word_list(file_extensions(), "or") +
                       ") selects the format")
      ->check([](const std::string& path) { return std::string(path.empty() ? "the name of the file is empty" : ""); });
}

}  // namespace nef
