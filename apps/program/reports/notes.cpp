// SPDX-License-Identifier: Apache-2.0
#include "apps/program/reports/notes.h"

#include <ostream>

#include "apps/program/run_program.h"
#include "nef/export/mesh_losses.h"
#include "nef/geometry/vectors.h"

namespace nef {

void print_notes(std::ostream& err, const std::string& program, std::span<const std::string> notes) {
  for (const std::string& line : printed_notes(notes)) err << program << ": " << line << '\n';
}

void Notes::note(const Messages& notes) {
  list_.insert(list_.end(), notes.begin(), notes.end());
  if (quiet_) return;
  Messages printed;
  for (const std::string& line : notes) {
    if (!line.starts_with(kOpenPartsClosed)) printed.push_back(line);
  }
  print_notes(err_, program_, printed);
}

void Notes::warn(const std::string& warning) {
  list_.push_back(warning);
  err_ << program_ << ": warning: " << one_line(warning) << '\n';
}

void Notes::wrote(const std::string& path, const WrittenFile& file) {
  if (!file.problem.empty()) warn(file.problem);
  if (is_zero(file.offset)) return;
  offsets_.emplace_back(path, file.offset);
  note({offset_note(path, file.offset)});
}

void Notes::add_offsets(Json& report) const {
  for (const auto& [path, offset] : offsets_) {
    report["offsets"][path] = {to_string(offset[0]), to_string(offset[1]), to_string(offset[2])};
  }
}

}  // namespace nef
