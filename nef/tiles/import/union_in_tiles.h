// SPDX-License-Identifier: Apache-2.0
//
// Unions of very many sets, region by region.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/union_order.h"
#include "nef/tiles/cuts/region_division.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef {

/// From how many sets on regions pay where the union stays in tiles (docs/scaling.md).
inline constexpr std::size_t kSetsForRegions = 1000;

/// How many sets a region has, if nothing else is said.
inline constexpr std::size_t kSetsOfARegion = 400;

/// Sets that are made when they are needed, each maybe several times. `set` may be called by several threads at once,
/// each with a monitor of its own.
struct PieceSource {
  std::uint32_t count = 0;
  std::function<Polyhedron(std::uint32_t piece, const Monitor& own)> set;
};

/// The union of many sets, as work on regions that do not depend on each other.
class RegionalUnion {
 public:
  /// `boxes`: of the boundary of each set, rounded outward (region_box). A region has at most `most` sets, where planes
  /// can separate these.
  RegionalUnion(std::vector<Box> boxes, std::size_t most);

  [[nodiscard]] std::size_t region_count() const { return division_.parts().size(); }
  /// The numbers of the sets that a region needs, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& pieces_of(std::size_t region) const {
    return division_.parts()[region].items;
  }

  /// True if sets meet at most two regions each, on average: otherwise regions repeat work rather than share it out.
  [[nodiscard]] bool is_spread() const;

  /// The union of some sets, among them all of a region, in this region.
  [[nodiscard]] TileRef unite_in(std::size_t region, std::vector<Polyhedron>&& sets, const Tiling& tiling,
                                 const Monitor& monitor) const;

  /// The whole from its parts, in the order of the regions.
  [[nodiscard]] TileRef tree(std::span<const TileRef> of_regions) const { return division_.tree(of_regions); }

 private:
  std::vector<Box> boxes_;
  RegionDivision division_;
};

/// The box of a piece for RegionalUnion: empty for the empty set, all of space where the set is unbounded.
Box region_box(const UnionOperand& piece);

/// The regions for some pieces, each of which is made once.
RegionalUnion divide_pieces(const PieceSource& pieces, std::size_t most = kSetsOfARegion, const Monitor& monitor = {});

/// The union of all pieces. Regions of at most `most` pieces are made at once on the threads of `monitor`; what is
/// in memory are the pieces of as many regions, and the tiles (see Tiling::store). O(n log n) for pieces that meet few
/// others.
TiledPolyhedron union_in_tiles(const PieceSource& pieces, const Tiling& tiling = {.limit = kVerticesOfTileInFile},
                               std::size_t most = kSetsOfARegion, const Monitor& monitor = {});
/// The same for pieces that have been divided already.
TiledPolyhedron union_in_tiles(const PieceSource& pieces, const RegionalUnion& regions, const Tiling& tiling,
                               const Monitor& monitor = {});

}  // namespace nef
