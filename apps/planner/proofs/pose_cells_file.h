// SPDX-License-Identifier: Apache-2.0
//
// Boxes of poses, and the rotations that a claim allows, in .proof files.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/planner/proofs/path_proof.h"
#include "apps/program/reports/json_reader.h"

namespace nef::planner {

/// The rotations of a claim: "all", or the quaternions of a chain.
nlohmann::json rotations_json(const std::vector<Quaternion>& rotations);
/// What that wrote; throws InputError for anything else.
std::vector<Quaternion> read_rotations(const JsonReader& reader);

/// Boxes of poses. `is_bounded`: the claim has a box, so nothing is said of what is beyond the bounds.
nlohmann::json pose_cells_json(const PathProof::PoseCells& cells, bool is_bounded);
/// What that wrote; throws InputError for anything else.
PathProof::PoseCells read_pose_cells(const JsonReader& reader, bool is_bounded);

}  // namespace nef::planner
