// SPDX-License-Identifier: Apache-2.0
//
// What convolution facets look like around a point that they hold.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/minkowski/convolution/arrangement/drawn_arcs.h"
#include "apps/minkowski/convolution/arrangement/facet_pyramids.h"
#include "nef/base/monitor.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef::minkowski {

/// Marks of arcs: a bit for each side of the unflipped plane that is the outside of a facet; and of all items, whether
/// they belong to the sum if they are on its boundary (ConvolutionFacets::marks).
inline constexpr LabelId kOutsideAbove = 1;
inline constexpr LabelId kOutsideBelow = 2;
inline constexpr LabelId kInSum = 4;

/// Draws facets around points. Several drawers of the same pyramids may work at the same time.
class PyramidDrawer {
 public:
  /// Facets and pyramids must outlive the object.
  PyramidDrawer(const ConvolutionFacets& facets, const FacetPyramids& pyramids, const Monitor& monitor)
      : facets_(facets), pyramids_(pyramids), monitor_(monitor) {}

  /// The arrangement of facets on a small sphere around a point of a table that they hold (FacetPyramids::facets_at):
  /// arcs, nodes and the centre marked with the bits above, and regions marked 0. Without any facet all is one region.
  SphereMapBuffer draw(const std::vector<FacetAtPoint>& at, const PointTable& points, PointId point);

 private:
  void draw_facet(const FacetAtPoint& at, const PointTable& points, PointId point);
  [[nodiscard]] std::uint64_t key_along(const FacetAtPoint& at, std::size_t side, bool forward) const;
  [[nodiscard]] LabelId label(std::uint8_t in_sum) const;
  struct BorderLabels {
    LabelId leaving = 0, arriving = 0, centre = 0;
  };
  [[nodiscard]] BorderLabels border_labels(std::uint32_t facet, const PointTable& points, PointId point) const;
  [[nodiscard]] bool is_on_side(std::uint32_t facet, std::uint32_t side, const PointTable& points, PointId point) const;
  [[nodiscard]] bool is_void(std::uint32_t facet) const;

  const ConvolutionFacets& facets_;
  const FacetPyramids& pyramids_;
  Monitor monitor_;
  DrawnArcs arcs_;
  LabelId centre_ = 0;  // of the drawing at hand
};

}  // namespace nef::minkowski
