// SPDX-License-Identifier: Apache-2.0
//
// Answers from a part of free space, for scenes with meshes, where all of it costs more.
#pragma once

#include <memory>
#include <optional>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/answer.h"

namespace nef::planner {

/// A path, and the free space that it was found in, which holds a part of the scene's or less of its obstacles.
struct PartialAnswer {
  Answer answer;
  std::shared_ptr<const FreeSpace> free;
};

/// A path from the scene's start to its goal with the best T and J that there are, 3: by interior_answer if robot or
/// obstacles are large solid meshes, by nearby_answer (nearby_answer.h) if obstacles are large surfaces. Nothing for
/// other scenes, and where these find none, which proves nothing. Throws Interrupted as free_positions does.
std::optional<PartialAnswer> partial_answer(const Scene& scene, const PathOptions& options,
                                            const Monitor& monitor = {});

/// True if the scene has start and goal, and robot and obstacles are bounded solids that may touch.
bool can_have_interior_answer(const Scene& scene);

/// A path through one volume of free space, in the closure of the inside of that. Nothing if start and goal are not in
/// contact with one and the same volume: there may be a way through a tight passage, or through one in contact. The
/// closed sums suffice, which the reduced convolution gives without convex cells; that is what it is for. The scene
/// must be one that can have such an answer. Throws Interrupted as free_positions does.
std::optional<PartialAnswer> interior_answer(const Scene& scene, const PathOptions& options,
                                             const Monitor& monitor = {});

}  // namespace nef::planner
