// SPDX-License-Identifier: Apache-2.0
//
// A sum or an erosion as work on regions that do not depend on each other.
//
// What of A + B lies in a region depends only on what A has within reach of B around the region, and so it is for
// erosions. Regions are parts of the tree of A, so the result is cut as A is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "nef/polyhedron.h"
#include "nef/tiles/region.h"
#include "nef/tiles/tile_tree.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::minkowski {

/// A region has at most so many vertices, as a rule. Measured: the sum of a scan's part of that size and a small ball
/// takes 100 MB, and regions repeat about a sixth of the work.
inline constexpr std::size_t kVerticesOfRegion = 8192;

/// A sum or an erosion of a bounded set in tiles by a bounded set, as work on regions that do not depend on each other.
/// May be read from several threads at once.
class RegionalSum {
 public:
  enum class Kind : std::uint8_t { kSum, kErosion };

  /// Regions have at most `most` vertices of A's tiles, or are less than four times as wide as B along the axis of the
  /// next cut: narrower ones would repeat most of each other's work. Throws InputError if a set is empty,
  /// UnsupportedError if one is unbounded.
  RegionalSum(Kind kind, const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor = {},
              std::size_t most = kVerticesOfRegion);
  /// The same for an offset that is not by 0; arguments are those of `offset` of a Polyhedron.
  RegionalSum(const TiledPolyhedron& a, const Rational& radius, int splits, Side side, const Monitor& monitor = {});

  [[nodiscard]] std::size_t region_count() const { return regions_.size(); }

  /// The result in a region. It costs the sum of B with the part of A around the region, whose memory it takes.
  [[nodiscard]] TileRef compute(std::size_t region, const MinkowskiOptions& options, MinkowskiReport& report) const;

  /// The whole result from its parts, in the order of the regions.
  [[nodiscard]] TiledPolyhedron whole(std::span<const TileRef> of_regions) const;

 private:
  [[nodiscard]] bool is_cut(const TileNode& node, const Region& region) const;
  void divide(const TileRef& tree, const Region& region);
  [[nodiscard]] TileRef joined(const TileRef& tree, const Region& region, std::span<const TileRef>& of_regions) const;
  [[nodiscard]] Polyhedron part_near(const Region& region, const Monitor& monitor) const;

  Kind kind_;
  TiledPolyhedron a_;  // regions refer to the planes of its tree
  Polyhedron b_;
  std::array<Rational3, 2> box_;    // around A
  std::array<Rational3, 2> reach_;  // a point of the result depends on A in this box around it
  Rational3 width_;                 // of B
  std::size_t most_;
  Rational margin_ = 1;  // by which parts of A are larger than they must be; a power of two
  std::vector<Region> regions_;
};

}  // namespace nef::minkowski
