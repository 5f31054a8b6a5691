// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/error.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// Throws InputError for the B of an opening or a closing that is empty.
inline void require_structuring_set(const Polyhedron& b) {
  if (b.is_empty()) throw InputError("the structuring set B is empty, so it cannot open or close anything");
}

}  // namespace nef::minkowski
