// SPDX-License-Identifier: Apache-2.0
//
// Sides are sorted by their corners; those of one facet stay in their order.
#include "apps/minkowski/convolution/arrangement/shared_sides.h"

#include "nef/mesh/edge_order.h"

namespace nef::minkowski {

SharedSides::SharedSides(const ConvolutionFacets& facets) : facets_(facets), group_(facets.corners.size()) {
  struct Side {
    std::uint64_t key = 0;  // of the corners
    std::uint32_t place = 0;
    std::uint32_t facet = 0;
  };
  std::vector<Side> sides;
  sides.reserve(facets.corners.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    const auto ring = facets.ring(f);
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
      sides.push_back({edge_key(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]), facets.begin[f] + i, f});
    }
  }
  sort_by_pair(sides, facets.points.size());
  members_.reserve(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].key != sides[i - 1].key) first_.push_back(static_cast<std::uint32_t>(i));
    group_[sides[i].place] = static_cast<std::uint32_t>(first_.size() - 1);
    members_.push_back(sides[i].facet);
  }
  first_.push_back(static_cast<std::uint32_t>(sides.size()));
}

}  // namespace nef::minkowski
