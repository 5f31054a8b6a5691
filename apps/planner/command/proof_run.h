// SPDX-License-Identifier: Apache-2.0
//
// `planner ... --proof FILE` and `planner SCENE --check-proof FILE` for .proof files (docs/proofs.md).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/planner/path/answer.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::planner {

/// Writes the proof of what is known of a path, if --proof asks for it; if that is kUndecided, a note says that there
/// is none.
void write_path_proof(const Arguments& a, const MotionChecker& checker, const std::vector<RigidPose>& poses,
                      const CertifiedPath& known);

/// Writes the proof of an answer about translations, if --proof asks for it: of its path, or else of the given points,
/// or that the free `positions` have no path. Throws InputError if there is no proof.
void write_translation_proof(const Arguments& a, const Scene& scene, const Polyhedron& positions, const Answer& answer,
                             const std::vector<Rational3>& points = {});

/// Prints what came of checking a proof: `complaint` is what does not hold, and `found` joins the report. Returns the
/// exit code: 0, it holds, 1, it does not.
int tell_check(const Arguments& a, const Scene& scene, const std::optional<std::string>& complaint,
               const nlohmann::json& found, const std::string& what_holds, const Stopwatch& watch);

/// Checks the .proof file that --check-proof names against the scene, and the path of --path, and prints what was
/// found: exit code 0, it holds, 1, it does not. Nothing if the file is no .proof file.
std::optional<int> run_check_proof(const Arguments& a, const Scene& scene);

}  // namespace nef::planner
