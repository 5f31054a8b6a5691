// SPDX-License-Identifier: Apache-2.0
//
// Proofs in files: JSON whose numbers are exact strings (docs/proofs.md).
#pragma once

#include <string>

#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// The word for a status: path, blocked or infeasible.
const char* status_word(PathProof::Claim::Status status);

/// The text of a .proof file.
std::string proof_text(const PathProof& proof);

/// True if a text is that of a .proof file, whole or not: it has a key "claim".
bool is_proof_text(const std::string& text);

/// Reads a .proof file. Only its form is checked, see complaint_about for what it proves. Throws InputError "name:
/// what" for a key that is missing, unknown or has a value of another kind.
PathProof parse_proof(const std::string& text, const std::string& name);

}  // namespace nef::planner
