// SPDX-License-Identifier: Apache-2.0
//
// From surviving intervals to the points at which a sum may have vertices.
#pragma once

#include <span>
#include <vector>

#include "apps/minkowski/convolution/vertex_finder.h"

namespace nef::minkowski {

/// What the intervals end at.
struct RegionVertices {
  std::vector<RegionVertex> vertices;
  std::vector<RegionJoint> joints;
  std::size_t points = 0;  ///< that were located exactly; such as several runs of intervals end at count for each
};

/// The points at which intervals end, with those of their drawings that may be vertices. If the sum need not be closed,
/// so are its saddle points and places where it may be as narrow as it can be. `facets` are those of the arrangement;
/// their table gets the points. The monitor is told of kSumPhase. The same for any number of threads.
RegionVertices region_vertices(const FacetArrangement& arrangement, ConvolutionFacets& facets,
                               std::span<const SaddlePoint> saddles, const Monitor& monitor);

}  // namespace nef::minkowski
