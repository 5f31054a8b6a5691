// SPDX-License-Identifier: Apache-2.0
//
// Which vertex an svertex or shalfedge belongs to; the converse of the ranges in VertexRecord.
#pragma once

#include "nef/complex/complex.h"

namespace nef {

/// Fills svertex_owner from the vertices. O(n).
void name_svertex_owners(Complex& complex);

/// Fills pair_owner from the vertices, unless svertex_owner is the same. O(n).
void name_pair_owners(Complex& complex);

}  // namespace nef
