// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>

#include "nef/tiles/region.h"

namespace nef {

/// A plane with a short coordinate that leaves about as many of the vertices where the set has boundary on either side.
/// `attempt` is 0, 1 or 2: along the axis in which these vertices reach farthest, the second one, the third one.
/// Nothing if their coordinates on that axis are all the same. Needs the sphere maps of the complex only.
std::optional<AxisPlane> halving_plane(const Complex& complex, std::size_t attempt);
/// The same for any finite places.
std::optional<AxisPlane> halving_plane(std::span<const std::array<double, 3>> places, std::size_t attempt);

}  // namespace nef
