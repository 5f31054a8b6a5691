// SPDX-License-Identifier: Apache-2.0
//
// The library's own format: every mark, open boundaries, lower-dimensional and unbounded parts, nothing rounded.
//
// It has two forms. Binary files (native_binary.h) hold a whole complex with all its links and are read as fast as they
// come; text is for people and for other programs.
//
// A text file is a list of words; '#' begins a comment. Integers have any length. It holds what is needed to rebuild a
// complex, namely its planes and the sphere maps of its vertices; edges, facets, shells and volumes are synthesized on
// reading.
//
//   nef 1                                      the word nef and the version of the format
//   planes P vertices V outer M                M is the mark of the outer volume
//   a b c d e                                  P planes ax + by + cz + d + eR = 0 (R is the infimaximal number)
//   vertex x y z w x' y' z' M  s e l f         V vertices at ((x + x'R) / w, ...), marked M, each followed by
//     p q out sface M                            s svertices: direction n_p x n_q; '-' for no shalfedge or no sface
//     p source next prev sface M                 e shalfedges; each even one and the next are twins
//     p sface M                                  l sloops
//     M  k item ...                              f sfaces: mark, number of boundary items; an item is
//                                                c<shalfedge> (a cycle), v<svertex> or l<sloop>
//   end
//
// Planes are numbered from 0 and written with a sign, +3 or -3, for the side that they are seen from; svertices,
// shalfedges, sloops and sfaces are numbered from 0 within their vertex. Marks are numbers; 0 is "not in the set"; an
// asterisk is the space beyond an infimaximal box.
#pragma once

#include <string>
#include <string_view>

#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef {

/// The polyhedron as text in this format. O(n).
std::string native_text(const Polyhedron& polyhedron);

/// Reads either form; `path` is for error messages only. Text is synthesized and checked by nef::validate, so that a
/// corrupt file cannot make an object that breaks its promises; binary files are known to be whole by their checksum.
/// Throws FileError.
Polyhedron read_native(std::string_view bytes, const std::string& path, const Monitor& monitor = {});

}  // namespace nef
