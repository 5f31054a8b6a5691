// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "apps/planner/free_space/free_space.h"
#include "apps/planner/path/answer.h"
#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// Poses that are not turned, at these positions.
std::vector<RigidPose> poses_at(const std::vector<Rational3>& positions);

/// The proof of an answer about translations: of its path, of the given one if that is blocked, of a start or goal that
/// collides, or that there is no path in all of free space, `free`, which else may be null. A path is certified anew,
/// pair by pair of pieces, and what is found must agree with the answer. Throws InputError if there is no such proof:
/// the answer is about no start and goal or was not found, only a surface is touched, or nothing separates start and
/// goal by a distance. Costs what make_path_proof or make_barrier_proof do.
PathProof proof_of_answer(const Scene& scene, const FreeSpace* free, const Answer& answer,
                          std::span<const RigidPose> given, const Monitor& monitor = {});

/// The proof that the tight passages of a free space are tight (make_tight_proof). Throws InputError if it has none, or
/// if there is no such proof.
PathProof proof_of_tight_passages(const Scene& scene, const FreeSpace& free, const Monitor& monitor = {});

}  // namespace nef::planner
