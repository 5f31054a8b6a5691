// SPDX-License-Identifier: Apache-2.0
//
// Where the boundaries of two operands meet: the candidate points of a Boolean operation
// (thesis 5.1). A point lies in the relative interior of one item of each complex, so the pair of
// items names it, and no coordinates are compared to find equal ones.
#pragma once

#include <array>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/operand.h"

namespace nef {

/// A point in the interior of an edge of one operand at least.
struct Crossing {
  PointId point;
  std::array<ItemRef, 2> item;  ///< in operand 0 and 1: two edges, or an edge and a facet
};

/// A place where an edge is touched by something of the other operand.
struct EdgeContact {
  HalfedgeId edge{0};  ///< smaller halfedge
  PointId point;
  ItemRef other;  ///< the item of the other operand
  auto operator<=>(const EdgeContact& o) const { return edge <=> o.edge; }
};

struct Intersections {
  /// For every vertex of each operand: the item of the other operand that holds it.
  std::array<IndexedVector<VertexId, ItemRef>, 2> vertex_item;
  std::vector<Crossing> crossings;
  /// Contacts inside edges of each operand, sorted by edge.
  std::array<std::vector<EdgeContact>, 2> contacts;
};

/// Finds all of them, on the threads of `monitor`. New points are added to the tables.
Intersections intersect_boundaries(const std::array<Operand, 2>& operands, CommonTables& tables,
                                   const Monitor& monitor);

}  // namespace nef
