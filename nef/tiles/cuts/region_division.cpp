// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/cuts/region_division.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "nef/tiles/cuts/halving_plane.h"

namespace nef {
namespace {

using Extent = RegionDivision::Extent;

// Middles, so that large items do not count more than small ones.
std::vector<std::array<double, 3>> middles(const std::vector<std::uint32_t>& items, const Extent& extent) {
  std::vector<std::array<double, 3>> result;
  result.reserve(items.size());
  for (const std::uint32_t item : items) {
    std::array<double, 3>& middle = result.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = extent(item, i);
      middle[i] = low / 2 + high / 2;
    }
  }
  return result;
}

// Those that touch the plane, or may touch it, are on both sides.
std::array<std::vector<std::uint32_t>, 2> split(const std::vector<std::uint32_t>& items, const Extent& extent,
                                                const AxisPlane& plane) {
  std::array<std::vector<std::uint32_t>, 2> result;
  for (const std::uint32_t item : items) {
    const auto [low, high] = extent(item, plane.axis);
    if (low <= plane.bounds[1]) result[0].push_back(item);
    if (high >= plane.bounds[0]) result[1].push_back(item);
  }
  return result;
}

bool goes_through(const AxisPlane& plane, const Region& region) {
  const AxisPlane* low = region.low[plane.axis];
  const AxisPlane* high = region.high[plane.axis];
  return (low == nullptr || low->at < plane.at) && (high == nullptr || plane.at < high->at);
}

}  // namespace

RegionDivision::RegionDivision(std::uint32_t items, const Extent& extent, std::size_t most) {
  std::vector<std::uint32_t> all(items);
  for (std::uint32_t i = 0; i < items; ++i) all[i] = i;
  spots_.emplace_back();
  divide(0, Region{}, std::move(all), extent, most);
}

void RegionDivision::divide(std::size_t spot, const Region& region, std::vector<std::uint32_t> items,
                            const Extent& extent, std::size_t most) {
  if (items.size() > most) {
    const std::vector<std::array<double, 3>> places = middles(items, extent);
    for (std::size_t attempt = 0; attempt < 3; ++attempt) {
      std::optional<AxisPlane> plane = halving_plane(places, attempt);
      if (!plane || !goes_through(*plane, region)) continue;
      std::array<std::vector<std::uint32_t>, 2> sides = split(items, extent, *plane);
      if (std::max(sides[0].size(), sides[1].size()) > items.size() - items.size() / 8) continue;
      items = {};
      const std::array<std::size_t, 2> spots{spots_.size(), spots_.size() + 1};
      spots_.resize(spots_.size() + 2);
      spots_[spot].plane = std::move(*plane);
      spots_[spot].spots = spots;
      const AxisPlane& cut = spots_[spot].plane;
      divide(spots[0], region.below(cut), std::move(sides[0]), extent, most);
      divide(spots[1], region.above(cut), std::move(sides[1]), extent, most);
      return;
    }
  }
  spots_[spot].part = parts_.size();
  parts_.push_back({region, std::move(items)});
}

TileRef RegionDivision::tree(std::size_t spot, std::span<const TileRef> of_parts) const {
  const Spot& at = spots_[spot];
  if (at.spots[0] == 0) return of_parts[at.part];
  TileRef low = tree(at.spots[0], of_parts);
  return cut_node(at.plane, std::move(low), tree(at.spots[1], of_parts));
}

}  // namespace nef
