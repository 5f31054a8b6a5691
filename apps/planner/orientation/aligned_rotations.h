// SPDX-License-Identifier: Apache-2.0
//
// Rotations at which faces of a robot are parallel to faces of obstacles: there, a way through a passage that is
// exactly as wide as the robot opens and closes again.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "apps/planner/rigid/rigid_motion.h"
#include "nef/base/monitor.h"
#include "nef/geometry/integer_vector.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// The directions across the faces of sets, as integers without a common factor; of a direction and its opposite the
/// larger one. O(n log n) for n facets.
std::set<Integer3> face_directions(std::span<const Polyhedron> sets);

/// The rotations that turn two directions of a robot's faces into directions of obstacles' faces at once, opposite ones
/// being alike: those that are rational, as canonical quaternions (orientation/rotations.h). With one direction given,
/// a robot still turns about it; with two it stands still. O(n^2 m^2) for n and m directions. `monitor` can stop it
/// (Interrupted).
std::set<Quaternion> aligned_rotations(const std::set<Integer3>& of_robot, const std::set<Integer3>& of_obstacles,
                                       const Monitor& monitor = {});

}  // namespace nef::planner
