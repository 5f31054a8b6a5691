// SPDX-License-Identifier: Apache-2.0
//
// Intervals that are gone take others with them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/convolution/arrangement/surviving_intervals.h"

namespace nef::minkowski {

/// An interval at a point where three facets cross.
struct IntervalLink {
  std::array<std::uint32_t, 3> at{};  ///< in ascending order
  std::uint32_t interval = kNone;     ///< kNone: it is gone
  bool smooth = false;                ///< two of the facets are in one plane and continue each other
  bool operator<(const IntervalLink& other) const { return at < other.at; }
};

/// Removes intervals that are linked to one that is gone, and so on. Where three facets cross, three intervals are in
/// front of all of them, or two if the point is smooth; a point with fewer links is left alone. O(n log n).
void remove_linked(std::vector<IntervalLink> links, std::vector<SurvivingInterval>& intervals);

}  // namespace nef::minkowski
