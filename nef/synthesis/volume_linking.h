// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef {

/// Last step of synthesis: sfaces that see each other across a facet or along an edge without
/// facets form shells; shells that are nested form volumes (thesis 4.6.4). Facets must be linked.
/// Near-linear, plus one ray for each connected component of the boundary after the first. On the threads of `monitor`.
void link_volumes(Complex& complex, LabelId outer, const Monitor& monitor);

}  // namespace nef
