// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/polyhedron.h"

namespace nef {

/// A volume in double precision that is off by at most `error`.
struct MeasuredVolume {
  double value = 0;
  double error = 0;
};

/// The volume of a bounded set. The exact one (nef::volume) of a detailed set can take longer than making the set, and
/// have millions of digits. O(n).
MeasuredVolume approximate_volume(const Polyhedron& bounded);

}  // namespace nef
