// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef {

/// The same set with its items in an order that depends on nothing but the set, and with points and lines without
/// facets written in one way: sets that are equal get complexes that are equal item for item, and so the same files.
/// Vertices come along a curve through space, planes as vertices use them. O(n log n), about half a Boolean operation.
Polyhedron in_canonical_order(const Polyhedron& set, const Monitor& monitor = {});

/// The vertices of a set in canonical order.
struct CanonicalVertices {
  Complex unlinked;   ///< planes, points, and vertices with their sphere maps; no links
  LabelId outer = 0;  ///< the mark of all of space if there are no vertices, else of the outer volume
};

/// The vertices that in_canonical_order() gives, without linking them. All links follow from them, so two sets are
/// equal if and only if these are. O(n log n).
CanonicalVertices canonical_vertices(const Polyhedron& set, const Monitor& monitor = {});

/// Where vertices of a complex that is to be written come from.
struct CanonicalPart {
  const Complex* complex = nullptr;     ///< their sphere maps and, unless there are none, twins
  std::span<const std::uint32_t> rows;  ///< of its planes in the common table; empty: they are the same
};
/// One of them.
struct CanonicalVertex {
  std::uint32_t part = 0;
  VertexId vertex{0};
};

/// The complex of some vertices of several complexes in that order, by the planes of a common table, on the threads
/// of `monitor`. Twins of a part are those of the result where both ends are among the vertices. `outer` is the mark of
/// all of space if there are no vertices.
Complex canonical_complex(PlaneTable&& planes, std::span<const CanonicalPart> parts,
                          std::vector<CanonicalVertex>&& vertices, LabelId outer, const Monitor& monitor);

}  // namespace nef
