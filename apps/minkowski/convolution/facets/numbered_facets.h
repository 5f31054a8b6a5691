// SPDX-License-Identifier: Apache-2.0
//
// Lists of facets put together.
#pragma once

#include <vector>

#include "apps/minkowski/convolution/facets/convolution_facets.h"
#include "apps/minkowski/convolution/facets/facet_list.h"

namespace nef::minkowski {

/// The facets of these lists, in their order, but for those that surely lie inside of the sum of A and B. Corners and
/// planes are numbered as they first come. On the threads of `monitor`, and the same for any number of them. O(n) for
/// n corners, and what CoveredVoxels takes.
ConvolutionFacets numbered_facets(const SolidFeatures& a, const SolidFeatures& b, BoundaryMarks marks,
                                  std::vector<FacetList>&& lists, const Monitor& monitor);

}  // namespace nef::minkowski
