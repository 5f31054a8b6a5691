// SPDX-License-Identifier: Apache-2.0
//
// The exact half of the arrangement of convolution facets: which of them hold a point, and what is near it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/convolution/facets/rounded_facets.h"
#include "nef/base/monitor.h"
#include "nef/geometry/predicates.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

/// A facet that holds a point, and the planes across those of its sides that do: none, one, or two at a corner.
struct FacetAtPoint {
  std::uint32_t facet = 0;
  std::array<PlaneId, 2> sides;                        ///< positive inside; invalid if there are fewer
  std::array<std::uint32_t, 2> numbers{kNone, kNone};  ///< of these sides, or of ones in line with them
};

/// Exact answers about facets. Adds planes and points to theirs. Not to be shared between threads.
class FacetPyramids {
 public:
  /// All must outlive the object. `tree` is over the boxes of the facets.
  FacetPyramids(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree, const Monitor& monitor)
      : facets_(facets), rounded_(rounded), tree_(tree), monitor_(monitor), side_plane_(facets.corners.size()) {}

  /// All facets that hold a point of their table. O(log n + k) for k boxes around it.
  const std::vector<FacetAtPoint>& facets_at(PointId point);

  /// True if a facet holds a point.
  [[nodiscard]] bool holds(std::uint32_t facet, PointId point);

  /// The plane through a side, on the inner side of which the facet is.
  PlaneId side_plane(std::uint32_t facet, std::uint32_t side);
  /// The same if somebody asked for it before, or an invalid one.
  [[nodiscard]] PlaneId known_side_plane(std::uint32_t facet, std::uint32_t side) const {
    return side_plane_[facets_.begin[facet] + side];
  }

  /// True if points near the one that a facet holds, in a direction from it, are on the facet.
  [[nodiscard]] bool goes_on(const FacetAtPoint& at, const Direction& direction) const;

  /// A point in a direction from another one, so near that it and all points between are in the same items: insides and
  /// sides of facets, or none.
  Rational3 point_towards(PointId from, const Direction& direction);

  /// True if an open segment between two points surely meets none but the given facets. Exact where doubles can not
  /// tell, up to touching sides.
  [[nodiscard]] bool sees(PointId from, PointId to, const std::vector<FacetAtPoint>& except);

 private:
  [[nodiscard]] bool locate(std::uint32_t facet, PointId point, FacetAtPoint& result);
  /// True if a facet goes on from a point to another one, and that and all between are in one item of it.
  [[nodiscard]] bool is_same_item(const FacetAtPoint& at, PointId from, PointId to);

  ConvolutionFacets& facets_;
  const RoundedFacets& rounded_;
  const BoxTree& tree_;
  Monitor monitor_;
  std::vector<PlaneId> side_plane_;  // per corner, invalid until asked for
  std::vector<FacetAtPoint> found_;
};

}  // namespace nef::minkowski
