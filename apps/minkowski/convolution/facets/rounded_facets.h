// SPDX-License-Identifier: Apache-2.0
//
// Convolution facets in doubles with proven bounds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"
#include "apps/minkowski/convolution/facets/convolution_facets.h"

namespace nef::minkowski {

/// The line of a side of a facet, projected along a coordinate axis.
struct RoundedSide {
  std::uint32_t u = 0, v = 1;  ///< the other two axes
  double normal_u = 0, normal_v = 0;
  double origin_u = 0, origin_v = 0;
  double slack = 0;   ///< bound of the error of value(x) for exact x
  double weight = 0;  ///< how an error of x enters

  /// Positive where the facet is.
  [[nodiscard]] double value(const Double3& x) const {
    return normal_u * (x[u] - origin_u) + normal_v * (x[v] - origin_v);
  }
};

/// Planes, sides and boxes of facets. The facets must outlive the object.
class RoundedFacets {
 public:
  /// O(corners), on the threads of `monitor`.
  RoundedFacets(const ConvolutionFacets& facets, const Monitor& monitor);

  [[nodiscard]] const RoundedFace& plane(std::uint32_t facet) const { return planes_[facet]; }
  /// Side i of a facet runs from corner i of its ring to the next one.
  [[nodiscard]] std::span<const RoundedSide> sides(std::uint32_t facet) const {
    return std::span(sides_).subspan(facets_.begin[facet], facets_.begin[facet + 1] - facets_.begin[facet]);
  }
  [[nodiscard]] const Box& box(std::uint32_t facet) const { return boxes_[facet]; }
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }
  /// A bound of how far a rounded corner is from the true one in each coordinate.
  [[nodiscard]] double corner_error() const { return 4 * kUnit * extent_; }
  /// The largest absolute coordinate.
  [[nodiscard]] double extent() const { return extent_; }
  /// False if sizes are such that the bounds do not hold.
  [[nodiscard]] bool are_proven() const { return has_moderate_size(extent_); }

 private:
  [[nodiscard]] std::array<std::size_t, 2> far_corners(std::uint32_t facet) const;
  void find_sides(std::uint32_t facet);

  const ConvolutionFacets& facets_;
  std::vector<RoundedFace> planes_;
  std::vector<RoundedSide> sides_;
  std::vector<Box> boxes_;
  double extent_ = 0;  // the largest absolute coordinate
};

}  // namespace nef::minkowski
