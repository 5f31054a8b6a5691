// SPDX-License-Identifier: Apache-2.0
//
// Where a segment crosses the plane of a facet: in the facet or beside it, as far as doubles can tell for sure.
#pragma once

#include <array>
#include <cstdint>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/partition/exact_point.h"
#include "nef/complex/complex.h"
#include "nef/number/approximation.h"

namespace nef::planner {

/// The point of the segment `from` + t (`to` - `from`) in which a linear form vanishes that has these values at its
/// ends; nothing is known of it if the values do not tell them apart for sure. `from` and `to` are within 2^-53
/// relative of the truth.
Approximation3 crossing_point(const Vector3d& from, const Vector3d& to, const Approximation& form_at_from,
                              const Approximation& form_at_to);

/// Where a point lies that is in the plane of a facet.
enum class InFacet : std::uint8_t {
  kOutside,  ///< surely not in the facet's closure
  kInside,   ///< surely within its cycles: in the facet, or on a vertex inside it
  kUnsure,
};
/// By counting edges beside the point. O(corners).
InFacet in_facet(const Complex& complex, const Facet& facet, const Approximation3& point);

}  // namespace nef::planner
