// SPDX-License-Identifier: Apache-2.0
//
// `planner ... --proof FILE` and `planner SCENE --check-proof FILE` for .proof files (docs/proofs.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/planner/path/answer.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// Throws InputError if --proof does not go with the other options.
void check_proof_usage(const Arguments& a);

/// Writes the proof of what is known of a path, if --proof asks for it; if that is kUndecided, a note says that there
/// is none.
void write_path_proof(const Arguments& a, const MotionChecker& checker, const std::vector<RigidPose>& poses,
                      const CertifiedPath& known);

/// Writes the proof of an answer about translations, if --proof asks for it: of its path, or else of the given points,
/// or that the free `positions` have no path. Throws InputError if there is no proof.
void write_translation_proof(const Arguments& a, const Scene& scene, const Polyhedron& positions, const Answer& answer,
                             const std::vector<Rational3>& points = {});

/// Checks the .proof file that --check-proof names against the scene, and the path of --path, and prints what was
/// found: exit code 0, it holds, 1, it does not. Nothing if the file is no .proof file.
std::optional<int> run_check_proof(const Arguments& a, const Scene& scene);

}  // namespace nef::planner
