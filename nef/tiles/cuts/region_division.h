// SPDX-License-Identifier: Apache-2.0
//
// Space cut into regions that few of many items meet.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "nef/tiles/tile_tree.h"

namespace nef {

/// A kd-tree of regions over items of known extent. It depends on the items and their order alone. Regions refer to it.
class RegionDivision {
 public:
  /// Two doubles between which coordinate `axis` of an item lies, both included.
  using Extent = std::function<std::array<double, 2>(std::uint32_t item, std::size_t axis)>;

  /// Cuts until at most `most` items meet a region, or planes do not separate them. O(n log n).
  RegionDivision(std::uint32_t items, const Extent& extent, std::size_t most);
  RegionDivision(const RegionDivision&) = delete;
  RegionDivision& operator=(const RegionDivision&) = delete;

  struct Part {
    Region region;
    std::vector<std::uint32_t> items;  ///< those that meet the closed region, and maybe some beside it; ascending
  };
  [[nodiscard]] std::span<const Part> parts() const { return parts_; }

  /// The items of a part, whose own are given up.
  [[nodiscard]] std::vector<std::uint32_t> take_items(std::size_t part) { return std::move(parts_[part].items); }

  /// The tree of what is in each part.
  [[nodiscard]] TileRef tree(std::span<const TileRef> of_parts) const { return tree(0, of_parts); }

 private:
  // A cut, or a part.
  struct Spot {
    AxisPlane plane;
    std::array<std::size_t, 2> spots{};  // none for a part
    std::size_t part = 0;
  };

  void divide(std::size_t spot, const Region& region, std::vector<std::uint32_t> items, const Extent& extent,
              std::size_t most);
  [[nodiscard]] TileRef tree(std::size_t spot, std::span<const TileRef> of_parts) const;

  std::deque<Spot> spots_;  // regions refer to their planes
  std::vector<Part> parts_;
};

}  // namespace nef
