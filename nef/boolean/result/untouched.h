// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/intersections.h"
#include "nef/location/query_structure.h"

namespace nef {

/// For every vertex of operand x that lies on nothing of the other operand: the mark of the
/// other's volume that holds it (others: unspecified). Vertices that an uncrossed edge joins share
/// their answer; touched ends and crossed edges give it away; only a component with neither asks
/// for a point location.
IndexedVector<VertexId, LabelId> marks_of_untouched(const std::array<Operand, 2>& operands, std::size_t x,
                                                    const CommonTables& tables, const Intersections& intersections,
                                                    const std::function<const QueryStructure&()>& queries_of_other,
                                                    const Monitor& monitor);

}  // namespace nef
