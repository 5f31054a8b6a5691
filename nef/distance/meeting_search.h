// SPDX-License-Identifier: Apache-2.0
//
// One question about two sets: do they meet, and if not, where do they touch?
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/distance/meeting_sets.h"

namespace nef {

/// True if some point of the first set is also in the second one, moved. The sets must have sides. O(k log n) for k
/// pairs of an edge and a facet whose boxes meet, and one point location for each connected part of a boundary that
/// touches nothing.
bool meet(const MeetingSets& sets, const Rational3& translation, const Monitor& monitor);

/// The same, and if not, the pairs of items at the vertices of the arrangement of both boundaries that lie on both
/// (IntersectionQuery::contacts()).
std::optional<std::vector<std::array<ItemRef, 2>>> contacts(const MeetingSets& sets, const Rational3& translation,
                                                            const Monitor& monitor);

}  // namespace nef
