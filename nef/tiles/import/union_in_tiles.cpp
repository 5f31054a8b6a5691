// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/import/union_in_tiles.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "nef/base/threads/parallel.h"
#include "nef/tiles/cuts/cutter.h"

namespace nef {
namespace {

// What reaches farther lies on the side of every cut that it may lie on.
constexpr double kFarthest = std::numeric_limits<double>::max();

// Of an empty box nothing.
std::array<double, 2> extent(const Box& box, std::size_t axis) {
  if (box.low[axis] > box.high[axis]) return {0, 0};
  return {std::max(box.low[axis], -kFarthest), std::min(box.high[axis], kFarthest)};
}

}  // namespace

Box region_box(const UnionOperand& piece) {
  if (piece.bounded) return piece.box;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box;
  box.low.fill(-kInfinity);
  box.high.fill(kInfinity);
  return box;
}

RegionalUnion::RegionalUnion(std::vector<Box> boxes, std::size_t most)
    : boxes_(std::move(boxes)),
      division_(
          static_cast<std::uint32_t>(boxes_.size()),
          [this](std::uint32_t piece, std::size_t axis) { return extent(boxes_[piece], axis); }, most) {}

TileRef RegionalUnion::unite_in(std::size_t region, std::vector<Polyhedron>&& sets, const Tiling& tiling,
                                const Monitor& monitor) const {
  return tiles_in_region(unite_all(std::exchange(sets, {}), monitor), division_.parts()[region].region, tiling,
                         monitor);
}

bool RegionalUnion::is_spread() const {
  std::size_t met = 0;
  for (const RegionDivision::Part& part : division_.parts()) met += part.items.size();
  return met <= 2 * boxes_.size();
}

RegionalUnion divide_pieces(const PieceSource& pieces, std::size_t most, const Monitor& monitor) {
  std::vector<Box> boxes(pieces.count);
  std::atomic<std::uint32_t> measured = 0;
  parallel_for(pieces.count, monitor, [&](std::size_t i, const Monitor& own) {
    boxes[i] = region_box(union_operand(pieces.set(static_cast<std::uint32_t>(i), own)));
    own.tell_progress_of_item("boxes of the pieces", measured++, pieces.count);
  });
  return {std::move(boxes), most};
}

TiledPolyhedron union_in_tiles(const PieceSource& pieces, const Tiling& tiling, std::size_t most,
                               const Monitor& monitor) {
  return union_in_tiles(pieces, divide_pieces(pieces, most, monitor), tiling, monitor);
}

TiledPolyhedron union_in_tiles(const PieceSource& pieces, const RegionalUnion& regions, const Tiling& tiling,
                               const Monitor& monitor) {
  std::vector<TileRef> trees(regions.region_count());
  std::atomic<std::size_t> done = 0;
  parallel_for(trees.size(), monitor, [&](std::size_t r, const Monitor& own) {
    std::vector<Polyhedron> sets;
    for (const std::uint32_t piece : regions.pieces_of(r)) sets.push_back(pieces.set(piece, own));
    trees[r] = regions.unite_in(r, std::move(sets), tiling, own);
    own.tell_progress("regions", ++done, trees.size());
  });
  return {regions.tree(trees), tiling};
}

}  // namespace nef
