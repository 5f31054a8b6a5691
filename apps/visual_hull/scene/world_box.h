// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "nef/number/number.h"

namespace nef::visual_hull {

/// A closed box in world units.
struct WorldBox {
  nef::Rational3 low, high;
};

/// Parses "x0,y0,z0,x1,y1,z1". Throws InputError.
WorldBox parse_box(const std::string& text);

/// Checks that the box has a volume. Throws InputError with `where` in front.
void check_box(const WorldBox& box, const std::string& where);

}  // namespace nef::visual_hull
