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

/// The sum of two bounded sets without cells if the strategy is that, or lets it be chosen and it is likely to be
/// faster; counts it in the report. `why` says why it was taken or was not.
std::optional<Polyhedron> sum_by_convolution(Summand& a, Summand& b, const MinkowskiOptions& options,
                                             MinkowskiReport& report, std::string& why);

/// The same for two sets of closed polygons in parallel planes, whose sum is a planar one, and with its entry in the
/// report.
std::optional<Polyhedron> flat_sum_by_convolution(const Polyhedron& a, const Polyhedron& b,
                                                  const MinkowskiOptions& options, MinkowskiReport& report);

/// union_of_pair_sums with an entry in the report about what united them, and why there were cells.
Polyhedron union_of_pair_sums_for(std::string why, std::span<const Product> products, const MinkowskiOptions& options,
                                  MinkowskiReport& report);

}  // namespace nef::minkowski
