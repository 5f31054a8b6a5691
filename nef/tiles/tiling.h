// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace nef {

/// How a set is kept in tiles.
struct Tiling {
  /// A tile with more vertices is cut, where a plane can separate them; two neighbours of less than half of it together
  /// are joined.
  std::size_t limit = 1024;
  /// Threads that work on tiles at once; 0: as many as the machine has. No result depends on it.
  unsigned threads = 1;
};

}  // namespace nef
