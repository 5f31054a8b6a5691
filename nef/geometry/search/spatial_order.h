// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "nef/base/monitor.h"

namespace nef {

/// A point by its cell on a Z-shaped curve (Morton, 1966) through the bounding box of all points: bits 3 k, 3 k + 1 and
/// 3 k + 2 tell in which half of a cube of the k-th smallest size it lies, so that points of neighbouring cells are
/// neighbours in space as a rule. What is not finite comes last.
struct SpatialKey {
  std::uint64_t cell;
  std::uint32_t index;
};

/// The keys of all points, ascending by cell, then by index. O(n), on the threads of `monitor`.
std::vector<SpatialKey> spatial_keys(std::span<const std::array<double, 3>> points, const Monitor& monitor = {});

/// The indices of points in the order of their keys, those of one cell sorted by `less`, which takes two indices. O(n)
/// where cells hold few.
std::vector<std::uint32_t> spatial_order(std::span<const std::array<double, 3>> points,
                                         const std::function<bool(std::uint32_t, std::uint32_t)>& less);

}  // namespace nef
