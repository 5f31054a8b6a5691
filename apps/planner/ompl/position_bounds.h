// SPDX-License-Identifier: Apache-2.0
//
// Where OMPL's planners look for positions of a robot that also turns.
#pragma once

#include <ompl/base/spaces/RealVectorBounds.h>

#include "apps/planner/scene/scene.h"

namespace nef::planner {

/** \brief The scene's box, a rounding larger so that it has extent; without one, a box around obstacles, start and goal
    with twice the robot's reach to spare. What checks states must know the scene's box itself. */
ompl::base::RealVectorBounds position_bounds(const Scene& scene);

}  // namespace nef::planner
