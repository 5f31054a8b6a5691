// SPDX-License-Identifier: Apache-2.0
//
// A set that is changed by one Boolean operation after the other.
#pragma once

#include <cstdint>
#include <optional>

#include "nef/tiles/tiled_polyhedron.h"

namespace nef {

enum class BooleanOperator : std::uint8_t { kUnion, kIntersection, kDifference, kSymmetricDifference };

/// Whether a sequence works in tiles.
enum class TileUse : std::uint8_t {
  kNever,
  kAlways,
  kWherePays  ///< once the steps so far were small beside the set, and the steps to come are worth the cutting
};

/// Does a known number of steps, in tiles where that pays. What decides are numbers of vertices, never the time on a
/// clock, and the result is the same in any case.
class StepSequence {
 public:
  /// `steps`: how many will follow.
  StepSequence(Polyhedron start, std::size_t steps, TileUse use = TileUse::kWherePays, const Tiling& tiling = {},
               const Monitor& monitor = {});

  /// The same for a set that is in tiles, and stays so.
  StepSequence(TiledPolyhedron start, std::size_t steps);

  /// The set becomes (the set) op b. Costs what the operation of Polyhedron or TiledPolyhedron does, and the cutting
  /// where it begins to work in tiles.
  void apply(BooleanOperator op, const Polyhedron& b, const Monitor& monitor = {});
  /// The same for an operand in tiles, of which those are looked at that meet the set's. Glues it if the set is whole.
  void apply(BooleanOperator op, const TiledPolyhedron& b, const Monitor& monitor = {});

  /// How many tiles the set is in; none while it is in none.
  [[nodiscard]] std::size_t tile_count() const { return tiled_ ? tiled_->tile_count() : 0; }
  /// Vertices of the set, or of all its tiles.
  [[nodiscard]] std::size_t vertex_count() const;

  /// The set in tiles, cut so if it is not.
  [[nodiscard]] TiledPolyhedron tiled(const Tiling& tiling, const Monitor& monitor = {}) const;
  /// The set in canonical order.
  [[nodiscard]] Polyhedron result(const Monitor& monitor = {}) const;
  /// The set, with its items as the last operation left them unless it is in tiles.
  [[nodiscard]] Polyhedron result_in_any_order(const Monitor& monitor = {}) const {
    return tiled_ ? tiled_->polyhedron(monitor) : plain_;
  }

 private:
  void choose(const Monitor& monitor);
  [[nodiscard]] double saving(const Polyhedron& b) const;

  Polyhedron plain_;
  std::optional<TiledPolyhedron> tiled_;  // instead, while it works in tiles
  std::size_t left_;
  TileUse use_;
  Tiling tiling_;
  double average_ = 0;     // saving of a step by tiles, in vertices that need not be written; of late
  std::size_t looks_ = 0;  // steps that it is of
  std::size_t seen_ = 0;   // steps so far
};

}  // namespace nef
