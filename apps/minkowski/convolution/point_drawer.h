// SPDX-License-Identifier: Apache-2.0
//
// Whether a sum may have a vertex at a point, by a drawing of the facets that hold it.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "apps/minkowski/convolution/arrangement/pyramid_drawer.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/geometry/point_table.h"
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

/// A point of a table in doubles: these are within 2^-51 of the truth, relatively.
inline Approximation3 near_point(const PointTable& points, PointId point) {
  Approximation3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = points.approximate(point)[i];
    result[i] = {x, 4 * kUnit * std::fabs(x) + 1e-300};
  }
  return result;
}

/// Draws the regions around points. What is found of points near each other before tells of further ones, so answers
/// may depend on the points that were drawn before, but the sum does not. Not to be shared between threads.
class PointDrawer {
 public:
  /// All must outlive the object.
  PointDrawer(const ConvolutionFacets& facets, const FacetPyramids& pyramids, const SumMembership& membership,
              const Monitor& monitor);

  /// The drawing at a point of a table, which the facets `at` hold. Nothing if the sum surely has no vertex there: all
  /// around is inside. `among_passages`: the point is not an end of a surviving interval.
  std::optional<RegionVertex> draw(const std::vector<FacetAtPoint>& at, const PointTable& points, PointId point,
                                   bool among_passages);
  /// The same, whatever is around the point.
  SphereMapBuffer draw_anyway(const std::vector<FacetAtPoint>& at, const PointTable& points, PointId point);

 private:
  [[nodiscard]] bool is_of_use(const PointTable& points, PointId point, bool open, bool among_passages,
                               const SphereMapView& map) const;

  const ConvolutionFacets& facets_;
  const SumMembership& membership_;
  Monitor monitor_;
  PyramidDrawer drawer_;
  InsideSearch inside_;
};

}  // namespace nef::minkowski
