// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nef/number/number.h"

namespace nef {

/// What is wound around equally often.
struct WindingVolume {
  std::size_t parts = 0;  ///< connected regions between the faces of the mesh
  Rational volume;        ///< of all of them
};

}  // namespace nef
