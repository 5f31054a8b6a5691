// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef {

/// A volume in double precision that is off by at most `error`.
struct MeasuredVolume {
  double value = 0;
  double error = 0;
};

/// The volume of a bounded set. The exact one (nef::volume) of a detailed set can take longer than making the set, and
/// have millions of digits. O(n). The number does not depend on that of the threads (0: as many as the machine has).
MeasuredVolume approximate_volume(const Polyhedron& bounded, unsigned threads = 1, const Monitor& monitor = {});

/// An area in double precision that is off by at most `error`.
struct MeasuredArea {
  double value = 0;
  double error = 0;
};

/// The area of all facets of a bounded set, each once; nef::surface_area, which is off by some units in the last place
/// only, takes longer than making a detailed set. O(n). The number does not depend on that of the threads.
MeasuredArea approximate_area(const Polyhedron& bounded, unsigned threads = 1, const Monitor& monitor = {});

}  // namespace nef
