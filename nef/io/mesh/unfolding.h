// SPDX-License-Identifier: Apache-2.0
//
// A limit for files whose objects stand for many copies of each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "nef/io/file_bytes.h"

namespace nef {

/// Counts what a file holds and what it unfolds to, in vertices, triangles and placed objects. Some hundred bytes can
/// unfold to any number of triangles when objects are placed within each other.
class Unfolding {
 public:
  static constexpr std::size_t kAlways = 1000000;   ///< items that any file may unfold to
  static constexpr std::size_t kMostCopies = 1000;  ///< of everything that the file holds

  /// `path` is for messages; it must outlive the object.
  explicit Unfolding(const std::string& path) : path_(path) {}

  /// Items that stand in the file, when they are read.
  void add_stored(std::size_t items) { stored_ += items; }
  /// Items that are placed, before that is done: an object with so many vertices and triangles. Throws FileError if all
  /// that was placed is more than the limits above, or than the machine has memory for.
  void add_placed(std::size_t items) {
    constexpr std::size_t kOfObject = 10;  // its map takes as long as some vertices
    constexpr std::size_t kBytesOfItem = 32;
    placed_ += items + kOfObject;
    const std::size_t most =
        std::min(std::max(kAlways, kMostCopies * stored_), std::max(most_bytes_read() / kBytesOfItem, 2 * stored_));
    if (placed_ > most) {
      throw FileError(FileProblem::kUnsupported,
                      path_ +
                          ": its objects unfold to more than a thousand copies of everything in it, or to more "
                          "than there is memory for; write it with fewer copies");
    }
  }

 private:
  const std::string& path_;
  std::size_t stored_ = 0;
  std::size_t placed_ = 0;
};

}  // namespace nef
