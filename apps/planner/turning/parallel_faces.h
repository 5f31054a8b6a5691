// SPDX-License-Identifier: Apache-2.0
//
// Angles at which a robot that turns may fit exactly.
#pragma once

#include <set>

#include "apps/planner/turning/turning_question.h"
#include "apps/planner/turning/turning_robot.h"

namespace nef::planner {

/// The turns in the question's range at which a face of the robot looks against a face of an obstacle or with it, as
/// far as they are rational.
std::set<Turn> turns_of_parallel_faces(const Scene& scene, const TurningRobot& robot, const TurningQuestion& question);

}  // namespace nef::planner
