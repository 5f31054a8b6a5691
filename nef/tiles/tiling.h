// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace nef {

class TileStore;

/// A limit for tiles that are kept in files, and for unions of many sets at once, which cut no tile twice: region by
/// region, tiles of 128 vertices take 1.7 times as long.
inline constexpr std::size_t kVerticesOfTileInFile = 1024;

/// How a set is kept in tiles.
struct Tiling {
  /// A tile with more vertices is cut, where a plane can separate them; two neighbours of less than half of it together
  /// are joined. Small tiles make small versions and fast steps, large ones few files.
  std::size_t limit = 128;
  /// Keeps the tiles within its memory, others in files; null: all are in memory. No result depends on it.
  std::shared_ptr<TileStore> store = nullptr;
};

}  // namespace nef
