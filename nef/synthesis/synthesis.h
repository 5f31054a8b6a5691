// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// Synthesizes edges, facets, shells and volumes from points, sphere maps and planes (thesis
/// 4.6). The sphere maps must be simplified and complete: every vertex of the complex is there.
/// `outer` is the mark of the outer volume, needed where there are no vertices at all (otherwise
/// the sphere maps tell). O(n log n). Owners and volumes are found on the threads of `monitor`.
void synthesize(Complex& complex, LabelId outer, const Monitor& monitor);

/// The same, item for item, where some links are known.
void synthesize(Complex& complex, LabelId outer, KnownLinks&& known, const Monitor& monitor);

}  // namespace nef
