// SPDX-License-Identifier: Apache-2.0
//
// Sums of solids from their reduced convolution, without convex cells.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "apps/minkowski/convolution/summand.h"
#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// How much there was to do.
struct ConvolutionReport {
  std::string why;                 ///< the sum was made so, or was not, in words
  std::size_t pairs_of_cells = 0;  ///< that the other way would have to sum, about (SolidFeatures::cells)
  bool is_put_off = false;         ///< cells seem to be faster, going by that number
  std::size_t facets = 0;          ///< of the reduced convolution
  std::size_t segments = 0;        ///< pairs of facets that meet in one
  std::size_t intervals = 0;       ///< parts of segments at which the boundary may be
  std::size_t points = 0;          ///< located exactly
  std::size_t regions = 0;  ///< and boundary items of which only an intersection could tell whether they are in the sum
};

/// True for sets that are bounded, not empty, and in the closure of their interiors: convolution_sum takes two of them.
/// O(n).
bool has_convolution(const Polyhedron& a);

/// True for two bounded closed sets one of which has_convolution, while the other one may have sheets, curves and
/// single points; convolution_sum takes these, too. O(n).
bool have_closed_convolution(const Polyhedron& a, const Polyhedron& b);

/// From so many pairs of cells on, convolution is no slower than cells.
inline constexpr std::size_t kFewPairsOfCells = 16;

/// A + B for two such sets. If `only_if_fast`, those of which cells are likely to be faster are left alone, and the
/// result is nothing: where both are convex, where few pairs of cells face many facets, and where parts of the boundary
/// are missing and millions of pairs of facets of the convolution lie in one plane upon each other. The monitor is told
/// of kSumPhase. The facets of the reduced convolution are arranged, without what is surely inside; what regions they
/// leave is inside if it is just behind a facet, and the others are tested: x is in A + B iff A meets x - B. If A or B
/// lacks something of its boundary, so may the sum, and passages as narrow as what passes (BoundaryMarker). Nothing
/// also for sums whose size is not between 2^-200 and 2^200 (has_moderate_size), and for these, all rare, of sets that
/// are not closed: edges with more than one wedge where neither set is convex; a single point in a facet that is marked
/// unlike it.
std::optional<Polyhedron> convolution_sum(Summand& a, Summand& b, bool only_if_fast, ConvolutionReport& report,
                                          const Monitor& monitor);

}  // namespace nef::minkowski
