// SPDX-License-Identifier: Apache-2.0
//
// All marks of a complex at once.
#pragma once

#include <cstddef>

#include "nef/complex/complex.h"

namespace nef {

/// Calls visit(mark) for every mark of a complex, const or not; kOutside among them. Vertices that share a pattern
/// share its marks, facets beside the same volumes theirs: these are visited once, and what visit makes of a mark
/// depends on the mark alone. O(n).
template <typename AnyComplex, typename Visit>
void for_each_mark(AnyComplex& c, Visit&& visit) {
  PatternTable::for_each_mark(c.patterns, visit);
  for (auto& item : c.sloops) visit(item.mark);
  FacetTable::for_each_mark(c.facets, visit);
  for (auto& item : c.volumes) visit(item.mark);
}

}  // namespace nef
