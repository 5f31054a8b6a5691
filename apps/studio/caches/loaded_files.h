// SPDX-License-Identifier: Apache-2.0
//
// Sets of files, kept as long as the files stay as they are: while somebody types, the same files are read again and
// again.
#pragma once

#include <string>
#include <utility>

#include "apps/studio/caches/recently_used.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/construct/crossings.h"
#include "nef/polyhedron.h"

namespace nef::studio {

class LoadedFiles {
 public:
  /// The set of a file, read as `nef` reads it. `messages` gets what was done to it, whether it is
  /// read now or was before. Throws InputError. Any number of threads may call it.
  Polyhedron load(const std::string& path, Crossings crossings, const Monitor& monitor, Messages& messages);

 private:
  struct Value {
    Polyhedron set;
    Messages messages;
  };

  RecentlyUsed<std::pair<std::string, Crossings>, Value> used_{8};
};

}  // namespace nef::studio
