// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace nef::mpi {

/// The folder OUT.work beside an output, which holds what tasks have finished until the output is there: a second run
/// of the same job goes on from it. All ranks must see it under the same path.
class WorkFolder {
 public:
  explicit WorkFolder(const std::string& output);

  /// Makes the folder, on rank 0. If it is one of another job (its text differs), what is in it is removed. Throws
  /// FileError if it cannot be made.
  void prepare(const std::string& job) const;

  /// The path of something in it.
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }

  /// Removes something in it, or all of it.
  void remove(const std::string& name) const;
  void remove() const;

 private:
  std::filesystem::path path_;
};

/// A file, or a folder of tiles, as part of a job's text: its path and a hash of what it holds, so that one that was
/// replaced makes another job, whatever its time says. Throws FileError if it is not there. O(bytes).
std::string file_identity(const std::string& path);

}  // namespace nef::mpi
