// SPDX-License-Identifier: Apache-2.0
//
// Answers from a part of free space, for scenes with meshes, where all of it costs more.
#pragma once

#include <memory>
#include <optional>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/answer.h"

namespace nef::planner {

/// A path from the scene's start to its goal with the best T and J that there are, 3: by interior_answer if robot or
/// obstacles are large solid meshes, by nearby_answer if obstacles are large surfaces. Nothing for
/// other scenes, and where these find none, which proves nothing. Throws Interrupted as free_positions does.
std::optional<Answer> partial_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor = {});

/// A path through one volume of free space, in the closure of the inside of that. Nothing unless the scene has start
/// and goal, and robot and obstacles are bounded solids that may touch; nor if start and goal are not in contact with
/// one and the same volume: there may be a way through a tight passage, or through one in contact. Throws Interrupted
/// as free_positions does.
std::optional<Answer> interior_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor = {});

/// The closure of the positions at which a solid robot is away from all solid obstacles. The closed sums suffice, which
/// the reduced convolution gives without convex cells; that is what interior answers are for.
Polyhedron interior_positions(const Scene& scene, const Monitor& monitor = {});

/// A path from the scene's start to its goal with the best T and J that there are, 3. Begins with no obstacle at all
/// and adds convex pieces of obstacles that the robot may touch on the way found so far, until there is none: around
/// the path, and around another one that shows T and J, what is free of these pieces is free. Nothing if there is no
/// such path, or if it takes too many steps, which proves nothing; nor unless some bounded obstacles that may be
/// touched are large meshes that bound no solid. Throws Interrupted as free_positions does.
std::optional<Answer> nearby_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor = {});

}  // namespace nef::planner
