// SPDX-License-Identifier: Apache-2.0
//
// The text format of CGAL's Nef_polyhedron_3 with a standard kernel (.nef3), which OpenSCAD's users have too.
//
// After the head with its counts there is a line for each item: its number, links in braces, geometry behind a bar, and
// its mark. Halfedges and halffacets are counted in both directions. What had to be found out, as it is documented
// nowhere: the volume of a halffacet lies on the positive side of its plane, around which its outer cycle turns
// counterclockwise; the shalfedges of that cycle are the ones whose circle is the opposite plane, so that the sface of
// a shalfedge and the halffacet of the same shalfedge belong to different volumes; "-2" stands for none.
#pragma once

#include <string>
#include <string_view>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/forward.h"

namespace nef {

/// The polyhedron as CGAL writes it. Marks other than 0 become 1, with a line in `messages`. Throws UnsupportedError if
/// the set is unbounded in a way that needs an infimaximal box, which a standard kernel does not have. O(n).
std::string nef3_text(const Polyhedron& polyhedron, Messages* messages = nullptr);

/// Reads that text; `path` is for error messages only. Vertices, directions, circles and marks are taken from the file,
/// simplified and synthesized anew; the result is checked by nef::validate. Throws FileError, also for
/// the format of an extended kernel.
Polyhedron read_nef3(std::string_view text, const std::string& path, const Monitor& monitor = {});

}  // namespace nef
