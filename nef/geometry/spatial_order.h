// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace nef {

/// The indices of points in the order of a Z-shaped curve through their bounding box (Morton, 1966): neighbours in it
/// are neighbours in space as a rule, so that arrays in this order are read along memory. Equal cells keep their order;
/// what is not finite comes last. O(n log n).
std::vector<std::uint32_t> spatial_order(std::span<const std::array<double, 3>> points);

/// The same with points of one cell sorted by `less`, which takes two indices.
std::vector<std::uint32_t> spatial_order(std::span<const std::array<double, 3>> points,
                                         const std::function<bool(std::uint32_t, std::uint32_t)>& less);

}  // namespace nef
