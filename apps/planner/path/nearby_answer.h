// SPDX-License-Identifier: Apache-2.0
//
// Answers that need only those parts of obstacles that the path comes near, for meshes that are surfaces.
#pragma once

#include <optional>

#include "apps/planner/path/partial_answer.h"

namespace nef::planner {

/// True if the scene has start and goal, the robot is a bounded solid, obstacles are bounded and may be touched, and at
/// least one of them is a large mesh that bounds no solid. (For solids a wide answer costs less.)
bool may_have_nearby_answer(const Scene& scene);

/// A path from the scene's start to its goal with the best T and J that there are, 3. Begins with no obstacle at all
/// and adds convex pieces of obstacles that the robot may touch on the way found so far, until there is none. The
/// free space that is returned is that of these pieces: around the path, and around another one that shows T and J, it
/// is the same as that of the scene. Nothing if there is no such path, or if it takes too many steps, which proves
/// nothing. The scene must be one that may have such an answer. Throws Interrupted as free_positions does.
std::optional<PartialAnswer> nearby_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor = {});

}  // namespace nef::planner
