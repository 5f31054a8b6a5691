// SPDX-License-Identifier: Apache-2.0
//
// From surviving intervals to the points at which a sum may have vertices.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/convolution/arrangement/facet_pyramids.h"
#include "apps/minkowski/convolution/arrangement/surviving_intervals.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/number/approximation.h"

namespace nef::minkowski {

/// A point at which the sum may have a vertex, and the regions around it: the sfaces of a drawing of all facets that
/// hold it, marked 1 if they are just behind a facet.
struct RegionVertex {
  PointId point{0};
  SphereMapBuffer map;
  bool is_saddle_point = false;
  /// All of the sum's boundary belongs to it, and it has no vertex here, whichever regions are inside: it is, or is
  /// not, that of a plane or an edge here. Such a point only joins regions.
  bool is_plain = false;
};

/// Two vertices at the ends of a part of a segment that nothing cuts.
struct RegionJoint {
  std::uint32_t segment = 0;
  std::uint32_t from = 0, to = 0;  ///< vertices
};

/// What the intervals end at.
struct RegionVertices {
  std::vector<RegionVertex> vertices;
  std::vector<RegionJoint> joints;
  std::size_t points = 0;  ///< that were located exactly
};

/// A point of a table in doubles: these are within 2^-51 of the truth, relatively.
inline Approximation3 near_point(const PointTable& points, PointId point) {
  Approximation3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = points.approximate(point)[i];
    result[i] = {x, 4 * kUnit * std::fabs(x) + 1e-300};
  }
  return result;
}

/// The points at which intervals end, with those of their drawings that may be vertices. If the sum need not be closed,
/// so are its saddle points and places where it may be as narrow as it can be. `tree` is over the boxes of the facets,
/// whose tables get more planes and points. The monitor is told of kSumPhase.
RegionVertices region_vertices(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree,
                               FacetPyramids& pyramids, const SurvivingIntervals& intervals,
                               const SumMembership& membership, std::span<const SaddlePoint> saddles,
                               const Monitor& monitor);

}  // namespace nef::minkowski
