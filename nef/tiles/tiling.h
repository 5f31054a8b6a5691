// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace nef {

class TileStore;

/// How a set is kept in tiles.
struct Tiling {
  /// A tile with more vertices is cut, where a plane can separate them; two neighbours of less than half of it together
  /// are joined.
  std::size_t limit = 1024;
  /// Threads that work on tiles at once; 0: as many as the machine has. No result depends on it.
  unsigned threads = 1;
  /// Keeps the tiles within its memory, others in files; null: all are in memory. No result depends on it.
  std::shared_ptr<TileStore> store = nullptr;
};

}  // namespace nef
