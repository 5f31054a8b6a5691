// SPDX-License-Identifier: Apache-2.0
//
// From candidate points to the sum: which regions around them are inside.
#pragma once

#include <cstddef>
#include <span>

#include "apps/minkowski/convolution/arrangement/surviving_intervals.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/complex/complex.h"

namespace nef::minkowski {

/// What came of an arrangement of facets, and counts for people who measure.
struct SumOfRegions {
  Complex sum;
  std::size_t points = 0;    ///< located exactly
  std::size_t tested = 0;    ///< regions and boundary items that only an intersection could tell
  std::size_t passages = 0;  ///< of the items, those that are missing though all around them is in the sum
};

/// Takes the points at which surviving intervals end, finds the regions around them, joins those that an interval
/// joins, and makes the sum. A region is inside if it is just behind a facet. Of others, a point on no facet is put to
/// the definition. If the sum need not be closed, so are its saddle points, places where it may be as narrow as it can
/// be, and what cannot be told by facets there. `tree` is over the boxes of the facets, whose tables get more planes
/// and points. The monitor is told of kSumPhase.
SumOfRegions sum_of_regions(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree,
                            const SharedSides& at_side, const SurvivingIntervals& intervals,
                            const SumMembership& membership, std::span<const SaddlePoint> saddles,
                            const Monitor& monitor);

}  // namespace nef::minkowski
