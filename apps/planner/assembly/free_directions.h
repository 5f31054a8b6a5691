// SPDX-License-Identifier: Apache-2.0
//
// In which directions a part can begin to move.
#pragma once

#include <array>
#include <vector>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/parts.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// The directions in which a part can begin to move while all others stay: a closed cone with its apex at the origin.
struct FreeDirections {
  Polyhedron cone;             ///< what of it lies in the cube from -1 to 1; only the origin if the part cannot move
  int dimension = 0;           ///< 3 with an inside, 2 flat, 1 lines, 0 nothing but the origin
  bool everything = false;     ///< nothing touches it
  std::vector<Integer3> rays;  ///< along its edges, and lines: without common factors, in order
  /// What a part forbids.
  struct Stop {
    std::size_t part = 0;
    OpenCone directions;
  };
  std::vector<Stop> stops;  ///< the cone is what these leave; those that others make superfluous are left out
};

/// The exact cone of a part. The parts must not overlap. O(k log k) for k normals of contact planes, and a Boolean for
/// each stop.
FreeDirections free_directions(Blocking& blocking, std::size_t part, const Monitor& monitor = {});

/// The same for a part of an assembly.
FreeDirections free_directions(const Assembly& assembly, std::size_t part, const Monitor& monitor = {});

}  // namespace nef::planner
