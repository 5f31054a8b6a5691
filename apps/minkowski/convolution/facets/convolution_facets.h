// SPDX-License-Identifier: Apache-2.0
//
// The reduced convolution of two solids: the facets that the boundary of their sum is made of, and more.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"
#include "apps/minkowski/convolution/facets/covered_voxels.h"
#include "apps/minkowski/convolution/facets/near_origin.h"
#include "apps/minkowski/convolution/facets/solid_features.h"
#include "nef/geometry/point_table.h"

namespace nef::minkowski {

/// Convex polygons with exact planes. Corners are numbered; the same sum of two vertices has one number, but equal
/// points may have several.
struct ConvolutionFacets {
  PlaneTable planes;
  PointTable points;             ///< of the corners
  std::vector<Double3> rounded;  ///< the same; each coordinate is the nearest double
  std::vector<PlaneId> plane;    ///< per facet, positive outside
  std::vector<std::uint32_t> begin{0};
  std::vector<std::uint32_t> corners;  ///< counterclockwise from outside; some may be straight

  /// Where something of a facet that lies on the boundary of the sum belongs to it: everywhere, nowhere, or where these
  /// marks say so, of insides per facet, of corners, and of the sides that begin at them.
  BoundaryMarks marks = BoundaryMarks::kAll;
  std::vector<std::uint8_t> inside_marks;
  std::vector<std::uint8_t> corner_marks;
  std::vector<std::uint8_t> side_marks;
  CoveredVoxels covered;  ///< what is known of the inside of the sum; facets there are left out

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(plane.size()); }
  [[nodiscard]] std::span<const std::uint32_t> ring(std::uint32_t facet) const {
    return {corners.data() + begin[facet], begin[facet + 1] - begin[facet]};
  }
};

/// Of a sum: if one of the sets has nothing of its boundary, so has the sum; if both have all of it, so has the sum.
BoundaryMarks marks_of_sum(BoundaryMarks a, BoundaryMarks b);

/// The sums of features of A and B at which A and a translate of -B can touch without one entering the other
/// nearby: facet and peak, two convex edges whose arcs of normals cross, facet and parallel edge, parallel facets.
///
/// A and B are bounded, and their boundaries bound them (SolidFeatures). Or both are closed, and one of them is a
/// solid; what follows is true then, too, with the solid's inside. Just behind each facet is the inside of A + B: there
/// a boundary point of one solid meets the inside of the other. And the facets cover the boundary of A + B: a point x
/// inside of a facet of the sum, but for a set without area, is a + b for items a of A and b of B whose sum has area
/// and whose local cones K_a and -K_b have no inside in common. So either one of them is a facet and the other cone is
/// on one side of its plane (it touches that plane in a point, an edge or a facet), or both are edges, and K_a
/// + K_b, which does not change along either, is a half-space. O(n m) signs for n and m features, most of which are
/// doubles, on the threads of `monitor`. Facets that surely do not come into the ball
/// `near` may be left out; then signs are taken of features of A that are near features of -B only.
ConvolutionFacets reduced_convolution(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor,
                                      const NearOrigin& near = NearOrigin(HUGE_VAL));

}  // namespace nef::minkowski
