// SPDX-License-Identifier: Apache-2.0
//
// Offsets with fewer triangles or shorter coordinates that still have proven bounds.
#pragma once

#include <cstddef>
#include <optional>

#include "apps/minkowski/morphology.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// How an offset is simplified; at least one of the two must be given.
struct SimplifyOptions {
  std::optional<std::size_t> triangles = std::nullopt;  ///< about so many (nef::decimate)
  std::optional<int> digits = std::nullopt;             ///< coordinates are rounded to so many decimals, 0 to 300
};

struct SimplifiedOffset {
  Polyhedron set;
  /// The set lies between the exact offsets by the radius and by one that differs from it by at most this, towards the
  /// side that was asked for. Where nothing was simplified, it is that of `offset`.
  Rational error;
  Messages notes;  ///< of the simplification
};

/// An offset of the solid parts of a set (see `offset`), simplified. The offset by a radius that is a little larger
/// (kOuter) or smaller (kInner) is simplified, by an amount that the distance of its surface from the simplified one
/// tells. Whether the result is between the offset by the radius and one by twice that amount is checked by Boolean
/// operations; if it is not, the amount is doubled. Costs three offsets, two simplifications and two Boolean
/// operations, as a rule. Throws InputError for options out of range, a set whose offset has no bounded solid part, and
/// for simplifications so rough that no amount was found.
SimplifiedOffset simplified_offset(const Polyhedron& a, const Rational& radius, int splits, Side side,
                                   const SimplifyOptions& simplify, const MinkowskiOptions& options = {},
                                   MinkowskiReport* report = nullptr);

}  // namespace nef::minkowski
