// SPDX-License-Identifier: Apache-2.0
//
// Sets of files, kept as long as the files stay as they are: while somebody types, the same files are read again and
// again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <mutex>
#include <string>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::studio {

class LoadedFiles {
 public:
  /// The set of a file, read as `nef` reads it (--crossings union). `messages` gets what was done to it, whether it is
  /// read now or was before. Throws InputError. Any number of threads may call it.
  Polyhedron load(const std::string& path, const Monitor& monitor, Messages& messages);

 private:
  static constexpr std::size_t kMost = 8;  // the last used ones

  struct Entry {
    std::string path;
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    Polyhedron set;
    Messages messages;
  };

  std::mutex mutex_;
  std::list<Entry> entries_;  // the last used one first
};

}  // namespace nef::studio
