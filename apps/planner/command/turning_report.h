// SPDX-License-Identifier: Apache-2.0
//
// Answers about robots that turn as data: JSON, text; and proofs read back.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/planner/turning/turning_search.h"

namespace nef::planner {

/// All keys of the report.
nlohmann::json turning_json(const TurningAnswer& answer, const Scene& scene, const TurningAxis& axis);
/// x y z degrees in doubles, a way-point a line.
std::string turning_text(const TurningAnswer& answer, const TurningAxis& axis);

/// The proof in a report. Throws InputError if it has none, or a broken one.
TurningProof read_turning_proof(const std::string& file);

}  // namespace nef::planner
