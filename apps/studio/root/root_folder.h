// SPDX-License-Identifier: Apache-2.0
//
// The one folder that the studio reads and writes. Names come from pages and from files that users may have from
// others, so each is resolved, links included, before anything is opened.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nef::studio {

/// A file below the root.
struct RootFile {
  std::string name;  ///< relative to the root, with '/'
  std::size_t bytes = 0;
};

class RootFolder {
 public:
  /// Throws InputError if there is no such folder.
  explicit RootFolder(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// The file of a name relative to the root, or to `folder`, which is relative to it. Throws InputError for an
  /// absolute name, one that leads out of the root (by ".." or by a link), and one that names no regular file.
  [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& folder = {}) const;
  /// Where a file of this name is to be written: its folder is there. Throws InputError as `file` does, and for hidden
  /// names.
  [[nodiscard]] std::filesystem::path target(const std::string& name) const;
  /// A name of a file of a mesh, maybe with "#PART" behind it: checked like `file`, the part kept.
  [[nodiscard]] std::string mesh(const std::string& name, const std::string& folder = {}) const;

  /// The bytes of a file, of at most `most`. Throws InputError.
  [[nodiscard]] std::string read(const std::string& name, std::size_t most) const;
  /// Writes a file whole or not at all (write_file). Throws InputError.
  void write(const std::string& name, std::string_view bytes) const;

  /// Files by name, without hidden ones and without folders that links lead to: the first `most` of them, four folders
  /// deep.
  [[nodiscard]] std::vector<RootFile> list(std::size_t most) const;

 private:
  [[nodiscard]] std::filesystem::path inside(const std::string& name, const std::string& folder) const;

  std::filesystem::path path_;  // canonical
};

}  // namespace nef::studio
