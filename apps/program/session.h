// SPDX-License-Identifier: Apache-2.0
//
// One run of a program: its flags, reading and writing with their times, what it prints.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/program/common_options.h"
#include "apps/program/reports/notes.h"
#include "apps/program/reports/progress_bar.h"
#include "apps/program/reports/run_report.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"

namespace nef {

/// Exit codes of the program.
enum ExitCode : int { kYes = 0, kNo = 1, kBad = 2 };

/// One run of the program of this name, which stands in front of every line on stderr.
class Session {
 public:
  Session(std::string program, std::ostream& out, std::ostream& err)
      : program_(std::move(program)), out_(out), err_(err), notes_(program_, err, quiet) {}

  // Set by the parser.
  bool json = false;
  bool quiet = false;
  bool exact = false;
  bool binary = false;
  bool text = false;
  bool polygons = false;
  MeshFileFlags mesh_file;  ///< of meshes that are written
  bool origins = false;
  std::string format;  ///< of the output, instead of its extension
  MeshOptions mesh;
  std::string output;
  std::string report;               ///< file for the report, whether or not --json prints it; "-": standard output
  std::string input;                ///< of subcommands with one operand
  std::vector<std::string> inputs;  ///< of others
  int repeat = 1;

  Monitor monitor = Monitor().on_threads(0);  ///< of the run; contains --threads
  int exit_code = kYes;

  /// Reads a set; its time is added to the phase "load", notes go to stderr unless quiet.
  Polyhedron load(const std::string& path);
  /// The same for many, several at once.
  std::vector<Polyhedron> load_all(const std::vector<std::string>& paths);
  /// As the first, watched by `monitor` instead of that of the run.
  Polyhedron load(const std::string& path, const Monitor& monitor);
  /// The set that a mesh bounds, by the flags; messages begin with `name`.
  Polyhedron solid_of(const Mesh& mesh, const std::string& name);
  /// Throws FileError if no set can be written to `output`: its extension is neither that of a format nor one of
  /// `others`, or its folder is missing. Programs call it before they read, so that no long run ends with it.
  void require_output(const std::vector<std::string>& others = {}) const;
  /// Writes a set to `output`, if there is one; "-" is standard output, which then holds nothing else.
  void store(const Polyhedron& set);
  /// The same to another path, with other options than the flags'.
  void store_at(const std::string& path, const Polyhedron& set, const PolyhedronWriteOptions& options);
  /// Writes a file by `write`: its time is added to the phase "write", its notes are shown.
  void write(const std::string& path, const std::function<WrittenFile(Messages& notes)>& write);
  /// Writes the closed surface of a solid to `output` (see write_solid_mesh).
  void store_mesh(Mesh surface, bool is_strict);
  /// How the flags ask for a set to be written to `output` or to another path.
  [[nodiscard]] PolyhedronWriteOptions write_options() const { return write_options(output); }
  [[nodiscard]] PolyhedronWriteOptions write_options(const std::string& path) const;
  /// Writes a set with labels to `output`, its faces in groups (see write_groups); returns how many each has.
  std::map<std::string, std::size_t> store_groups(const Polyhedron& labeled, const BoundaryGroups& groups);

  /// Shows what is being done, to somebody at a terminal who wants to see it, until something else is printed.
  void show_phase(const std::string& phase, std::size_t done = 0, std::size_t total = 0);

  /// Removes what show_phase shows, before something is printed otherwise than by a session.
  void hide_phase();

  /// Keeps a note and shows it (see Notes).
  void note(const std::string& text);
  /// The same for many, of which some are shown.
  void note_all(const Messages& notes);
  /// All notes and warnings so far: what was done to inputs, and what an output does not hold.
  [[nodiscard]] const Messages& notes() const { return notes_.list(); }
  /// Adds to a report what --recenter subtracted (see Notes); `print` does so itself.
  void add_offsets(Json& report) const { notes_.add_offsets(report); }
  /// Prints a line for people; nothing if quiet or --json. It goes to stderr if the report has standard output.
  void say(const std::string& line);
  /// Tells the report what a phase took: one between reading and writing, or "load" or "write" in place of what `load`
  /// and `write` have taken.
  void spent(const std::string& phase, double seconds, std::optional<PredicateCounts> predicates = std::nullopt);
  /// Makes the report of the run (see run_report): what the command found, the phases so far, the notes. It is printed,
  /// with --json or if it goes to no file, and written to that.
  void print(const std::string& command, const Json& found);
  /// Prints a line on stderr whatever the flags.
  void complain(const std::string& line);

 private:
  std::vector<Polyhedron> load_all(const std::vector<std::string>& paths, const Monitor& monitor);

  std::string program_;
  double load_s_ = 0;
  double write_s_ = 0;
  std::vector<ReportPhase> phases_;  // between reading and writing
  std::ostream& out_;
  std::ostream& err_;
  Notes notes_;
  std::unique_ptr<ProgressBar> bar_;  // made when first needed: the flags are known then
};

/// Flags that all programs have: --json, --quiet, --threads.
void add_run_flags(CLI::App* command, Session& session);
/// Flags about reading meshes: --strict, --as-surface, --crossings, --close.
void add_input_flags(CLI::App* command, Session& session);
/// -o and flags about writing: --format, --exact, --binary, --text, --polygons, --manifold, --recenter, --lenient.
CLI::Option* add_output_flags(CLI::App* command, Session& session);

}  // namespace nef
