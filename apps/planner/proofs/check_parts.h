// SPDX-License-Identifier: Apache-2.0
//
// What the checks of proofs have in common.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// Whether all points lie in one plane. O(n^2).
bool is_flat(std::span<const Rational3> piece);

/// The weighted sum of points, if there is a weight for each, none is negative (with `positive`: or zero), and they add
/// up to 1.
std::optional<Rational3> weighted_sum(std::span<const Rational3> points, std::span<const Rational> weights,
                                      bool positive);

/// What is wrong with the barrier of a proof, which must have one; nothing if no path of translations leads from the
/// first pose to the last. O(n log n) for n triangles.
std::optional<std::string> complaint_about_barrier(const PathProof& proof);

}  // namespace nef::planner
