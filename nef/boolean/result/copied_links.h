// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/intersections.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// Consecutive vertices of a result: copies of consecutive vertices of an operand, or new ones.
struct VertexRun {
  static constexpr std::size_t kNew = 2;
  std::size_t origin = kNew;  ///< 0 or 1 for the operands
  VertexId first{0};          ///< vertex of the operand, or number among the new vertices
  std::uint32_t count = 0;
};

/// The twins and facets that a result has from its operands. An edge between two copies that the other operand crosses
/// nowhere keeps its ends, and a facet keeps its cycles if all its corners are copies without crossed edges; whatever
/// the other operand leaves in its interior is found beside them. `runs` tell of all vertices of the result, in their
/// order; copies of an operand are in its order. O(n), one pass over the arrays, on the threads of `monitor`.
KnownLinks copied_links(const Complex& result, std::span<const VertexRun> runs,
                        const std::array<const Complex*, 2>& operands,
                        const std::array<std::vector<EdgeContact>, 2>& contacts, const Monitor& monitor);

}  // namespace nef
