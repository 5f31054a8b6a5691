// SPDX-License-Identifier: Apache-2.0
//
// Files as they were when they were read, to know whether what was made of them still holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace nef::studio {

/// When a file was written and how long it is; take it before the file is read.
class FileState {
 public:
  explicit FileState(std::filesystem::path file) : file_(std::move(file)) { look(written_, bytes_); }

  /// Whether the file is as it was.
  [[nodiscard]] bool still_holds() const {
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    look(written, bytes);
    return written == written_ && bytes == bytes_;
  }

 private:
  void look(std::filesystem::file_time_type& written, std::uintmax_t& bytes) const {
    std::error_code error;
    written = std::filesystem::last_write_time(file_, error);
    bytes = std::filesystem::file_size(file_, error);
  }

  std::filesystem::path file_;
  std::filesystem::file_time_type written_;
  std::uintmax_t bytes_ = 0;
};

/// Of the file of "FILE" or "FILE#PART", a part of it.
inline FileState state_of_mesh(const std::string& path) {
  std::error_code error;
  return FileState(std::filesystem::exists(path, error) ? path : path.substr(0, path.rfind('#')));
}

/// Whether all files are as they were.
inline bool still_hold(const std::vector<FileState>& files) {
  return std::all_of(files.begin(), files.end(), [](const FileState& file) { return file.still_holds(); });
}

}  // namespace nef::studio
