// SPDX-License-Identifier: Apache-2.0
//
// How far the doubles of a Direction may be off: for code that encloses directions instead of asking for signs.
#pragma once

#include "nef/number/approximation.h"

namespace nef {

/// Direction::cross takes doubles for a cross product of plane normals (components below 1 in magnitude) only if the
/// largest component exceeds this; otherwise it goes to integers at once.
inline constexpr double kLeastCross = 0x1p-20;

/// The error of a component of that cross product. u = 2^-53. Components of normals are cut off by GMP: 2u. A product
/// of two is off by 2u + 2u and its rounding u; the difference of two by 10u and its rounding, at most 2u: 12u, and
/// higher terms. Twice as much leaves room.
inline constexpr double kCrossError = 24 * kRoundingUnit;

/// What Direction::error is at most, for directions whose largest component is scaled to 1: about 2^-28.3. The 2u more
/// are the rounding of the scale and of the product with it. Directions from integers are off by 4u only.
inline constexpr double kMostDirectionError = (kCrossError + 2 * kRoundingUnit) / kLeastCross;

}  // namespace nef
