// SPDX-License-Identifier: Apache-2.0
//
// What files of proofs have in common: how numbers and pieces are spelled and read, and the frame around claim and
// witness.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/planner/proofs/path_proof.h"
#include "apps/program/reports/json_reader.h"

namespace nef::planner {

/// Pieces by their vertices, as exact strings.
nlohmann::json pieces_json(const ProofPieces& pieces);

/// What these wrote, in the one spelling that a number has: a string, whole or a fraction in lowest terms. Throw
/// InputError for anything else.
Rational proof_number(const JsonReader& reader);
Rational3 proof_point(const JsonReader& reader);
ProofPieces proof_pieces(const JsonReader& reader);
/// The number of an item, a JSON integer.
std::uint32_t proof_index(const JsonReader& reader);

/// The text of a file with a claim and a witness.
std::string proof_frame(nlohmann::json claim, nlohmann::json witness);

/// Requires the keys of a file, and the version of the format that this program knows.
void require_frame(const JsonReader& root);

}  // namespace nef::planner
