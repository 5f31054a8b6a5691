// SPDX-License-Identifier: Apache-2.0
//
// What a run says about its inputs and outputs, in one format in all programs.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/reports/run_report.h"
#include "nef/construct/construct.h"
#include "nef/io/polyhedron_file.h"

namespace nef {

/// Prints each note as a line "PROGRAM: note: ..." on `err`, the first few of very many (see printed_notes).
void print_notes(std::ostream& err, const std::string& program, std::span<const std::string> notes);

/// The notes and warnings of one run: printed as they come up, and kept for its report. A note says what was done to an
/// input or what a file does not hold, and is not printed if the run is quiet. A warning says that a file is not what
/// it should be although the exit code is 0, so it is printed in any case.
class Notes {
 public:
  /// `quiet` is read whenever something is to be printed; it must outlive this.
  Notes(std::string program, std::ostream& err, const bool& quiet)
      : program_(std::move(program)), err_(err), quiet_(quiet) {}

  /// Keeps notes and prints them.
  void note(const Messages& notes);
  /// Keeps a warning and prints it, "PROGRAM: warning: ...".
  void warn(const std::string& warning);
  /// Says what is to be known of a file that was written: a warning if its mesh is illegal, a note if its coordinates
  /// are not those of the set (--recenter).
  void wrote(const std::string& path, const WrittenFile& file);

  /// All of them, in the order in which they came up.
  [[nodiscard]] const Messages& list() const { return list_; }
  /// Adds to a report what --recenter subtracted, if it did: `offsets`, three exact numbers for each file.
  void add_offsets(Json& report) const;

 private:
  std::string program_;
  std::ostream& err_;
  const bool& quiet_;
  Messages list_;
  std::vector<std::pair<std::string, Rational3>> offsets_;
};

}  // namespace nef
