// SPDX-License-Identifier: Apache-2.0
//
// Sets in tiles to look at: a piece for each tile, made once for as long as the tile is there, so that a page that has
// the pieces of the set before gets those of the tiles that have changed.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/studio/tiles/piece.h"
#include "nef/base/monitor.h"
#include "nef/number/approximation.h"
#include "nef/tiles/tile_tree.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::studio {

/// A set in tiles as it is drawn, and what is known of it by its tiles.
struct DrawnTiles {
  std::vector<Piece> pieces;
  std::size_t triangles = 0;
  std::optional<Approximation> volume;  ///< nothing if it is infinite
};

class TilePieces {
 public:
  explicit TilePieces(PieceNumbers& numbers) : numbers_(numbers) {}

  /// Draws a bounded set. O(tiles), and O(size) for each tile that was not there in the last few sets. Any number of
  /// threads may call it.
  DrawnTiles draw(const TiledPolyhedron& set, const Monitor& monitor);

 private:
  struct Entry {
    std::shared_ptr<const TileNode> node;  // stays, so that no other one gets its address
    Piece piece;
    std::size_t triangles = 0;
    Approximation volume;
    std::uint64_t used = 0;
  };
  using Key = std::pair<const TileNode*, bool>;  // a node, and whether its complement is meant

  static Key key_of(const TileRef& leaf) { return {leaf.node.get(), leaf.complemented}; }
  Entry made(const TileRef& leaf, const Monitor& monitor);
  std::vector<Entry> entries_of(const std::vector<TileRef>& leaves, const Monitor& monitor);
  void forget_old();

  PieceNumbers& numbers_;
  std::mutex mutex_;
  std::map<Key, Entry> entries_;
  std::uint64_t clock_ = 0;
};

}  // namespace nef::studio
