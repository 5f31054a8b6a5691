// SPDX-License-Identifier: Apache-2.0
//
// Answers that need no tight passages, for robots and obstacles that are meshes.
#pragma once

#include <memory>
#include <optional>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/answer.h"

namespace nef::planner {

/// A path, and the free space that it was found in: the closure of the inside of the scene's free space.
struct WideAnswer {
  Answer answer;
  std::shared_ptr<const FreeSpace> free;
};

/// True if the scene has start and goal, and robot and obstacles are bounded solids that may touch.
bool can_have_wide_answer(const Scene& scene);

/// True if besides one of them is so large a mesh that it pays to look for a path without tight passages first.
bool may_have_wide_answer(const Scene& scene);

/// A path from the scene's start to its goal through one volume of free space, so with the best T and J that there are.
/// Nothing if start and goal are not in contact with one and the same volume, which proves nothing: there may be a way
/// through a tight passage, or through one in contact. The closed sums suffice, which the reduced convolution gives
/// without convex cells; that is what it is for. The scene must be one that can have such an answer. Throws Interrupted
/// as free_positions does.
std::optional<WideAnswer> wide_answer(const Scene& scene, const PathOptions& options, const BuildOptions& build = {});

}  // namespace nef::planner
