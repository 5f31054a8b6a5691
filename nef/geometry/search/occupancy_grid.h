// SPDX-License-Identifier: Apache-2.0
//
// A coarse picture of where boxes are, to tell in bulk what is far from all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/geometry/search/box_tree.h"

namespace nef {

/// Where a box lies among the cells of a grid: along each axis the numbers of its first and last cell, counted from 1;
/// a first one beyond the grid, or a last one of 0, if it lies beside the region.
struct CellRange {
  std::array<std::uint8_t, 3> first{255, 255, 255};
  std::array<std::uint8_t, 3> last{0, 0, 0};

  /// Of the box around both.
  void add(const CellRange& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] = std::min(first[i], other.first[i]);
      last[i] = std::max(last[i], other.last[i]);
    }
  }
};

/// A grid of cells over a region, each either empty or touched by a marked box. Coordinates go to cells by a monotone
/// function, so that boxes with a common point in the region have a common cell: a miss is a proof. Boxes of many
/// points are cheapest by way of the ranges of their points.
class OccupancyGrid {
 public:
  /// Cells for about `boxes` boxes: 64 along x, at most as many along y and z, so that marking a box costs no more than
  /// asking a tree of that many boxes would in the worst case.
  OccupancyGrid(const Box& region, std::size_t boxes);

  [[nodiscard]] CellRange range(const Box& box) const;

  /// True if a box overlaps the region.
  [[nodiscard]] bool reaches(const CellRange& box) const {
    return box.first[0] <= last_[0] + 1U && box.last[0] > 0 && box.first[1] <= last_[1] + 1U && box.last[1] > 0 &&
           box.first[2] <= last_[2] + 1U && box.last[2] > 0;
  }

  /// Marks all cells that a box meets, which must reach the region.
  void mark(const CellRange& box);

  /// False only if no marked box meets the given one, which must reach the region, within it.
  [[nodiscard]] bool touches(const CellRange& box) const;

 private:
  [[nodiscard]] std::uint32_t cell(std::size_t axis, double x) const;

  Box region_;
  std::array<double, 3> scale_{};
  std::array<std::uint32_t, 3> last_{};  // cells along each axis, less one
  std::vector<std::uint64_t> rows_;      // by z, then y
};

}  // namespace nef
