// SPDX-License-Identifier: Apache-2.0
//
// Taking an assembly apart with a clearance.
#pragma once

#include "apps/planner/assembly/disassembly.h"
#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace nef::planner {

/// As take_apart, but parts that move keep at least `distance` from parts that rest, from beginning to end. `overlap`
/// names two parts that are closer than that where they are. Each part is enlarged by a polytope around the ball of
/// half the distance (around_ball), so steps keep the distance; what is `inseparable` is so also with a polytope inside
/// that ball, which proves it for the distance itself. What lies between is `undecided`. Throws InputError unless the
/// distance is positive.
Disassembly take_apart_clear(const Assembly& assembly, const Rational& distance, const DisassemblyOptions& options = {},
                             const Monitor& monitor = {});

}  // namespace nef::planner
