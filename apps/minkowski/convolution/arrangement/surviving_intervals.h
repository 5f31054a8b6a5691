// SPDX-License-Identifier: Apache-2.0
//
// The parts of the segments at which regions may be seen that no facet has behind it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/convolution/arrangement/facet_segments.h"
#include "apps/minkowski/convolution/arrangement/shared_sides.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/base/monitor.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

/// Points of a segment that are next to each other, and in which order is not sure: its ends, and where other facets
/// meet it.
struct SegmentCut {
  std::uint32_t first = 0, last = 0;  ///< range in SurvivingIntervals::cutting
  std::array<bool, 2> is_end{};       ///< the segment may begin, end here
  Interval at;                        ///< they are all here
};

/// An open part of a segment that no other facet meets.
struct SurvivingInterval {
  std::uint32_t segment = 0;
  std::uint32_t from = 0, to = 0;  ///< cuts; the same one for all that is between its points, if there is anything
};

struct SurvivingIntervals {
  std::vector<FacetSegment> segments;
  std::vector<SegmentCut> cuts;
  std::vector<std::uint32_t> cutting;  ///< facets
  std::vector<SurvivingInterval> intervals;
  /// What else a sum that lacks parts of its boundary has to look at: cuts where it is not sure that facets are in
  /// general position, as segments and cuts, and corners that may touch other facets.
  std::vector<std::array<std::uint32_t, 2>> doubtful;
  std::vector<std::uint32_t> touching;
};

/// All segments, cut where they meet other facets, without intervals at which surely nothing is to be seen but the
/// inside of the sum: a point of them is seen to be inside (`membership`, a grid); or a facet crosses at one end that
/// has them behind it: just behind a facet is inside, up to the next one. Where three facets cross, and no other is
/// there, one octant is in front of all three; if one of its three edges goes, so do the others.
/// `tree` is over the boxes of the facets. `passages`: find doubtful cuts and touching corners, too. The monitor is
/// told of kSumPhase. In doubles: what is not sure, stays. O(n log n + k) for k pairs of segments on one facet whose
/// boxes overlap.
SurvivingIntervals surviving_intervals(const ConvolutionFacets& facets, const RoundedFacets& rounded,
                                       const BoxTree& tree, const SharedSides& at_side, const SumMembership& membership,
                                       bool passages, const Monitor& monitor);

}  // namespace nef::minkowski
