// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a path to write to, for those who write and for those who ask before a long computation.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "nef/base/text/word_list.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"

namespace nef {

/// The error of a path to write a set to whose extension no format has: it lists those that there are, after `others`
/// that the caller writes besides.
inline FileError unknown_extension(const std::string& path, std::vector<std::string> others = {}) {
  const std::vector<std::string> known = file_extensions();
  others.insert(others.end(), known.begin(), known.end());
  return {FileProblem::kUnreadable, path + ": unknown extension; use " + word_list(others, "or")};
}

/// Throws FileError (kUnreadable) if the folder of the path is missing, as write_file would after the computation.
inline void require_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (folder.empty() || std::filesystem::exists(folder, error)) return;
  const std::string why = std::make_error_code(std::errc::no_such_file_or_directory).message();
  throw FileError(FileProblem::kUnreadable, path + ": cannot be written (" + why + "); does its folder exist?");
}

}  // namespace nef
