// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/polyhedron.h"

namespace nef {

/// The same set with its items in an order that depends on nothing but the set, and with points and lines without
/// facets written in one way: sets that are equal get complexes that are equal item for item, and so the same files.
/// Vertices come along a curve through space, planes as vertices use them. O(n log n), about half a Boolean operation.
Polyhedron in_canonical_order(const Polyhedron& set);

/// The same for the vertices of a complex that are not linked yet, by the planes of a table.
Complex canonical_complex(PlaneTable&& planes, const Complex& vertices, LabelId outer);

}  // namespace nef
