// SPDX-License-Identifier: Apache-2.0
//
// Which strategy sums two sets, and why.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "apps/minkowski/convolution/summand.h"
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/sum/pair_sums.h"

namespace nef::minkowski {

/// A sum, or why there is none.
struct TriedConvolution {
  std::optional<Polyhedron> sum;
  bool is_put_off = false;  ///< cells seemed to be faster, going by an estimate of how many pairs of them there are
};

/// The sum of two bounded sets without cells if the strategy is that, or lets it be chosen and it is likely to be
/// faster; counts it in the report. `choice` says why it was taken or was not, and what there is to do.
TriedConvolution sum_by_convolution(Summand& a, Summand& b, const MinkowskiOptions& options, MinkowskiReport& report,
                                    StrategyChoice& choice);

/// The same after that was put off, if there are far more pairs of cells than was estimated; nothing if not.
std::optional<Polyhedron> sum_by_convolution_after_all(Summand& a, Summand& b, std::size_t pairs_of_cells,
                                                       const MinkowskiOptions& options, MinkowskiReport& report,
                                                       StrategyChoice& choice);

/// The same for two sets of closed polygons in parallel planes, whose sum is a planar one, and with its entry in the
/// report.
std::optional<Polyhedron> flat_sum_by_convolution(const Polyhedron& a, const Polyhedron& b,
                                                  const MinkowskiOptions& options, MinkowskiReport& report);

/// union_of_pair_sums with an entry in the report about what united them; `choice` says why there were cells.
Polyhedron union_of_pair_sums_for(StrategyChoice choice, std::span<const Product> products,
                                  const MinkowskiOptions& options, MinkowskiReport& report);

}  // namespace nef::minkowski
