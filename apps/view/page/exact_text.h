// SPDX-License-Identifier: Apache-2.0
//
// Exact coordinates as pages have them.
#pragma once

#include <string>

#include "nef/complex/complex.h"

namespace nef::view {

/// "x y z".
std::string point_text(const Complex& complex, VertexId vertex);
/// "a b c d": a x + b y + c z + d = 0.
std::string plane_text(const Complex& complex, FacetId facet);

}  // namespace nef::view
