// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/complex/complex.h"

namespace nef {

/// The closed solid whose boundary is a given closed surface (marked 1, its volumes 0): volumes that are an odd number
/// of facets away from the outer one are marked 1. Throws InputError if some facet has the same parity on both sides:
/// the surface separates nothing there. O(n).
Complex fill_by_parity(Complex surface);

}  // namespace nef
