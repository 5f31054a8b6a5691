// SPDX-License-Identifier: Apache-2.0
//
// Which facets share a side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/convolution/facets/convolution_facets.h"

namespace nef::minkowski {

/// The facets at each side of a facet, that one among them: those with a side between the same two corners.
class SharedSides {
 public:
  /// O(n log n) for n sides. The facets must outlive the object, and keep their corners.
  explicit SharedSides(const ConvolutionFacets& facets);

  /// In ascending order. Valid as long as the object. O(1).
  [[nodiscard]] std::span<const std::uint32_t> operator()(std::uint32_t facet, std::uint32_t side) const {
    const std::uint32_t group = group_[facets_.begin[facet] + side];
    return std::span(members_).subspan(first_[group], first_[group + 1] - first_[group]);
  }

 private:
  const ConvolutionFacets& facets_;
  std::vector<std::uint32_t> group_;    // per side: those between the same corners
  std::vector<std::uint32_t> first_;    // per group, in `members_`
  std::vector<std::uint32_t> members_;  // facets
};

}  // namespace nef::minkowski
