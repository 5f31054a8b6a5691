// SPDX-License-Identifier: Apache-2.0
//
// Layers of orientations in .proof files.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/planner/proofs/path_proof.h"
#include "apps/program/reports/json_reader.h"

namespace nef::planner {

/// Layers of orientations.
nlohmann::json layers_json(const PathProof::Layers& layers);
/// What that wrote; throws InputError for anything else.
PathProof::Layers read_layers(const JsonReader& reader);

}  // namespace nef::planner
