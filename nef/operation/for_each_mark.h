// SPDX-License-Identifier: Apache-2.0
//
// All marks of a complex at once.
#pragma once

#include <cstddef>

#include "nef/complex/complex.h"

namespace nef {

/// Calls visit(mark) for the mark of every vertex, svertex, shalfedge, sloop, sface, facet and volume of a complex,
/// const or not; kOutside among them. O(n).
template <typename AnyComplex, typename Visit>
void for_each_mark(AnyComplex& c, Visit&& visit) {
  for (std::size_t v = 0; v < c.vertex_count(); ++v) visit(c.vertices[v].mark);
  for (auto& item : c.svertices) visit(item.mark);
  for (auto& item : c.shalfedges) visit(item.mark);
  for (auto& item : c.sloops) visit(item.mark);
  for (auto& item : c.sfaces) visit(item.mark);
  for (auto& item : c.facets) visit(item.mark);
  for (auto& item : c.volumes) visit(item.mark);
}

}  // namespace nef
