// SPDX-License-Identifier: Apache-2.0
//
// The exact half of the arrangement of convolution facets: which of them hold a point, and what is near it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/convolution/arrangement/shared_sides.h"
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

/// Exact answers about facets, for points of any table. May be shared between threads.
class FacetPyramids {
 public:
  /// All must outlive the object. `tree` is over the boxes of the facets. Adds planes across facets to their table, for
  /// sides with no other plane beyond. O(corners), on the threads of the monitor.
  FacetPyramids(ConvolutionFacets& facets, const RoundedFacets& rounded, const SharedSides& at_side,
                const BoxTree& tree, const Monitor& monitor);

  /// All facets that hold a point, in place of what was in `found`. O(log n + k) for k boxes around it.
  void facets_at(const PointTable& points, PointId point, std::vector<FacetAtPoint>& found,
                 const Monitor& monitor) const;

  /// True if a facet holds a point.
  [[nodiscard]] bool holds(std::uint32_t facet, const PointTable& points, PointId point, const Monitor& monitor) const;

  /// A plane through a side, on the inner side of which the facet is: as a rule that of a facet beyond the side. The
  /// same for sides in line with each other.
  [[nodiscard]] PlaneId side_plane(std::uint32_t facet, std::uint32_t side) const {
    return side_plane_[facets_.begin[facet] + side];
  }

  /// True if points near the one that a facet holds, in a direction from it, are on the facet.
  [[nodiscard]] bool goes_on(const FacetAtPoint& at, const Direction& direction, const Monitor& monitor) const;

  /// A point in a direction from another one, so near that it and all points between are in the same items: insides and
  /// sides of facets, or none.
  [[nodiscard]] Rational3 point_towards(const PointTable& points, PointId from, const Direction& direction,
                                        const Monitor& monitor) const;

  /// True if an open segment between two points surely meets none but the given facets. Exact where doubles can not
  /// tell, up to touching sides.
  [[nodiscard]] bool sees(const PointTable& points, PointId from, PointId to, const std::vector<FacetAtPoint>& except,
                          const Monitor& monitor) const;

 private:
  [[nodiscard]] bool locate(std::uint32_t facet, const PointTable& points, PointId point, FacetAtPoint& result,
                            const Monitor& monitor) const;
  [[nodiscard]] PlaneId plane_beyond(std::uint32_t facet, std::uint32_t side, const Monitor& monitor) const;
  /// True if a facet goes on from a point to another one, and that and all between are in one item of it.
  [[nodiscard]] bool is_same_item(const FacetAtPoint& at, const PointTable& points, PointId from, PointId to,
                                  const Monitor& monitor) const;

  const ConvolutionFacets& facets_;
  const RoundedFacets& rounded_;
  const SharedSides& at_side_;
  const BoxTree& tree_;
  std::vector<PlaneId> side_plane_;  // per corner
};

}  // namespace nef::minkowski
