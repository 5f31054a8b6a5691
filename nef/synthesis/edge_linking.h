// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// First step of synthesis: pairs the svertices of all sphere maps into edges (fills
/// complex.twin). Owners must be known. Both ends of an edge carry the same planes around them, so
/// svertices are grouped by their two smallest planes (by their line where there are fewer), and
/// only groups of more than two are sorted along their line. Expected O(n). The links do not depend on the threads.
void link_edges(Complex& complex, const Monitor& monitor);

/// The same where some twins are known, which are taken out of `known`. O(number of the others).
void link_edges(Complex& complex, KnownLinks& known, const Monitor& monitor);

}  // namespace nef
