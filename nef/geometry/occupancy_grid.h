// SPDX-License-Identifier: Apache-2.0
//
// A coarse picture of where boxes are, to tell in bulk what is far from all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/geometry/box_tree.h"

namespace nef {

/// A grid of cells over a region, each either empty or touched by a marked box. Coordinates go to cells by a monotone
/// function, so that boxes with a common point in the region have a common cell: a miss is a proof.
class OccupancyGrid {
 public:
  /// Cells for about `boxes` boxes: 64 along x, at most as many along y and z, so that marking a box costs no more than
  /// asking a tree of that many boxes would in the worst case.
  OccupancyGrid(const Box& region, std::size_t boxes);

  /// Marks all cells that the box meets. A box beside the region marks border cells: harmless.
  void mark(const Box& box);

  /// False only if no marked box meets the given one within the region.
  [[nodiscard]] bool touches(const Box& box) const;

 private:
  struct Range {
    std::uint64_t bits;  // along x
    std::uint32_t y0, y1, z0, z1;
  };
  [[nodiscard]] Range range(const Box& box) const;
  [[nodiscard]] std::uint32_t cell(std::size_t axis, double x) const;

  std::array<double, 3> low_{};
  std::array<double, 3> scale_{};
  std::array<std::uint32_t, 3> last_{};  // cells along each axis, less one
  std::vector<std::uint64_t> rows_;      // by z, then y
};

}  // namespace nef
