// SPDX-License-Identifier: Apache-2.0
//
// The exact half of the arrangement of convolution facets: which of them hold a point, and what they look like there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/convolution/rounded_facets.h"
#include "nef/sphere_map/overlay.h"

namespace nef::minkowski {

/// Marks of arcs: a bit for each side of the unflipped plane that is the outside of a facet; and of all items, whether
/// they belong to the sum if they are on its boundary (ConvolutionFacets::marks).
inline constexpr LabelId kOutsideAbove = 1;
inline constexpr LabelId kOutsideBelow = 2;
inline constexpr LabelId kInSum = 4;

/// A facet that holds a point, and the planes across those of its sides that do: none, one, or two at a corner.
struct FacetAtPoint {
  std::uint32_t facet = 0;
  std::array<PlaneId, 2> sides;  ///< positive inside; invalid if there are fewer
};

/// Exact answers about facets. Adds planes and points to theirs. Not to be shared between threads.
class FacetPyramids {
 public:
  /// All must outlive the object. `tree` is over the boxes of the facets.
  FacetPyramids(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree)
      : facets_(facets), rounded_(rounded), tree_(tree), side_plane_(facets.corners.size()) {}

  /// All facets that hold a point of their table. O(log n + k) for k boxes around it.
  const std::vector<FacetAtPoint>& facets_at(PointId point);

  /// The arrangement of these facets on a small sphere around the point: arcs, nodes and the centre marked with the
  /// bits above, and regions marked 0.
  SphereMapBuffer draw(const std::vector<FacetAtPoint>& at, PointId point);

  /// True if a facet holds a point.
  [[nodiscard]] bool holds(std::uint32_t facet, PointId point);

  /// The plane through a side, on the inner side of which the facet is.
  PlaneId side_plane(std::uint32_t facet, std::uint32_t side);

  /// A point in a direction from another one, so near that all points between are on the same facets.
  Rational3 point_towards(PointId from, const Direction& direction);

  /// True if an open segment between two points surely meets none but the given facets. Exact where doubles can not
  /// tell, up to touching sides.
  [[nodiscard]] bool sees(PointId from, PointId to, const std::vector<FacetAtPoint>& except);

 private:
  [[nodiscard]] bool locate(std::uint32_t facet, PointId point, FacetAtPoint& result);
  [[nodiscard]] bool goes_on(const FacetAtPoint& at, const Direction& direction) const;
  void draw_facet(const FacetAtPoint& at, PointId point, SphereMapBuffer& out);
  [[nodiscard]] LabelId label(std::uint8_t in_sum) const;
  struct BorderLabels {
    LabelId leaving = 0, arriving = 0, centre = 0;
  };
  [[nodiscard]] BorderLabels border_labels(std::uint32_t facet, PointId point) const;
  [[nodiscard]] bool is_on_side(std::uint32_t facet, std::uint32_t side, PointId point) const;
  [[nodiscard]] bool is_void(std::uint32_t facet) const;

  ConvolutionFacets& facets_;
  const RoundedFacets& rounded_;
  const BoxTree& tree_;
  std::vector<PlaneId> side_plane_;  // per corner, invalid until asked for
  std::vector<FacetAtPoint> found_;
  SphereOverlay overlay_;
  LabelFunction or_{8, 8, [](LabelId a, LabelId b) { return static_cast<LabelId>(a | b); }};
  Arrangement drawing_;
  std::array<SphereMapBuffer, 3> maps_;
};

}  // namespace nef::minkowski
