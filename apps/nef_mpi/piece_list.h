// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/tiles/import/union_in_tiles.h"

namespace nef::mpi {

/// Sets that are named rather than held: files, and the lines of a file of expressions.
class PieceList {
 public:
  /// `list`: a file with an expression (as of `nef eval`) a line, or empty. Lines without one are left out. Throws
  /// InputError for a wrong expression, with its line, and FileError.
  PieceList(std::vector<std::string> files, const std::string& list, const MeshOptions& options);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(files_.size() + lines_.size()); }
  /// Makes a set. Errors tell of the file, or of the list and the line.
  [[nodiscard]] Polyhedron set(std::uint32_t piece, const Monitor& monitor) const;
  /// What tells this list from others: the expressions, and the content of every file that is named, in them or beside
  /// them. Reads these files once each; throws InputError for one that is not there, with its line.
  [[nodiscard]] std::string identity() const;

 private:
  struct Line {
    std::size_t number = 0;  // counted from 1
    std::string expression;
    std::vector<std::string> files;  // that it names, as paths from here
  };

  [[nodiscard]] std::string path_of(const std::string& file) const;
  [[nodiscard]] std::string place(const Line& line) const;

  std::vector<std::string> files_;
  std::string list_;
  std::vector<Line> lines_;
  MeshOptions options_;
};

}  // namespace nef::mpi
