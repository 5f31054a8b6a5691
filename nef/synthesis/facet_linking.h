// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// Second step of synthesis: links the shalfedges into facet cycles, groups cycles by plane and
/// nests them into facets (thesis 4.6.2, 4.6.3). Edges must be linked. Expected O(n), plus
/// O(m log m) in planes that hold several facets with m edges. Partly on the threads of `monitor`.
void link_facets(Complex& complex, const Monitor& monitor);

/// The same, item for item, where some facets are known.
void link_facets(Complex& complex, const KnownLinks& known, const Monitor& monitor);

}  // namespace nef
