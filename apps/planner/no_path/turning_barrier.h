// SPDX-License-Identifier: Apache-2.0
//
// Proofs for files that a robot that translates and turns about one axis has no path.
#pragma once

#include <optional>

#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_proof.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// The proof by layers of orientations that a scene with one axis has no path, made of the proof by cells of angles
/// that the search has found. In each cell the barrier is the boundary of the sum of a small cube and the inner robot's
/// free positions on one side, which is bounded; between two cells, what only one of these sums has is blocked. Both
/// are cut until one pair of pieces blocks each part.
///
/// Nothing if both sides have no distance in some cell (contact is forbidden, say, and they are open), if only surfaces
/// are in the way, or if it takes more than 10^5 triangles and tetrahedra. What is returned has been checked by
/// complaint_about. Costs two sums and a decomposition for each cell, and some small programs for each part. Throws
/// Interrupted if the monitor stops it, and InputError as question_of does.
std::optional<PathProof> make_turning_proof(const Scene& scene, const TurningProof& found, const Monitor& monitor = {});

}  // namespace nef::planner
