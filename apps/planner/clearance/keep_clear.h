// SPDX-License-Identifier: Apache-2.0
//
// Paths that keep a distance.
#pragma once

#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A polytope of 30 faces that holds the ball of this radius about the origin and lies in one 1.2 times as large.
Polyhedron around_ball(const Rational& radius, const Monitor& monitor = {});

/// Makes the robot larger by around_ball(distance): whatever is free then keeps at least that distance from all
/// obstacles, wherever the robot is turned, and all that keeps 1.2 times the distance is free. Adds a message that says
/// so. Throws InputError unless the distance is positive.
void keep_clear(Scene& scene, const Rational& distance, const Monitor& monitor = {});

}  // namespace nef::planner
