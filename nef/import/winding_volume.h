// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "nef/number/number.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef {

/// How exactly volumes are measured.
enum class Measure : std::uint8_t {
  kNot,      ///< they are not
  kDoubles,  ///< in doubles with proven bounds, O(n)
  kExactly,  ///< as rationals, which may have millions of digits
};

/// What is wound around equally often.
struct WindingVolume {
  std::size_t parts = 0;    ///< connected regions between the faces of the mesh
  MeasuredVolume measured;  ///< of all of them, by Measure::kDoubles
  Rational volume;          ///< of all of them, by Measure::kExactly
};

}  // namespace nef
