// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/geometry/ids.h"

namespace nef {

/// The mark of the set at each of many points, exactly: locate(a, p).mark for the rationals that the doubles are. The
/// points must be finite numbers; throws InputError naming the first that is not. Regions of cells that no facet, edge
/// or vertex enters are answered by one point location each, so far from the boundary a point costs some nanoseconds;
/// near it, a point location. On the threads of `monitor`.
std::vector<LabelId> locate_many(const Polyhedron& a, std::span<const std::array<double, 3>> points,
                                 const Monitor& monitor = {});

}  // namespace nef
