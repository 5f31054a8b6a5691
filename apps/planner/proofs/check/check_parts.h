// SPDX-License-Identifier: Apache-2.0
//
// What the checks of proofs have in common.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// Whether all points lie in one plane. O(n^2).
bool is_flat(std::span<const Rational3> piece);

/// The weighted sum of points, if there is a weight for each, none is negative (with `positive`: or zero), and they add
/// up to 1.
std::optional<Rational3> weighted_sum(std::span<const Rational3> points, std::span<const Rational> weights,
                                      bool positive);

/// The outward normals of the planes through two of some vectors that have all of them on one side: those around the
/// cone that the vectors span. Nothing if they lie in one plane, or are on no plane's one side. O(n^3).
std::vector<Rational3> outer_planes(std::span<const Rational3> vectors);

/// Three vectors that span space, those of a passage first: the axes without it; of one vector, this and the axes other
/// than the first one in which it is not zero; of two, these and their cross product. Nothing if they are dependent.
std::optional<std::array<Rational3, 3>> tight_frame(std::span<const Rational3> along);

/// Whether a direction is in the span of the vectors of a passage, which are linearly independent.
bool is_along(std::span<const Rational3> along, const Rational3& direction);

/// The sum of two vectors, neither zero, the shorter one (by the sum of absolute values) first multiplied by the
/// largest power of two with which it is not the longer one: a direction near to the middle of theirs.
Rational3 balanced_sum(const Rational3& a, const Rational3& b);

/// Whether all of some points are beyond the same side of a box; false without a box.
bool is_beyond_a_side(const std::optional<std::array<Rational3, 2>>& box, std::span<const Rational3> points);

/// Whether a ray from a point crosses an odd number of triangles. A ray through an edge or a corner does not count, so
/// others are tried; nothing if all of them are such, or the point is in the plane of a triangle that they cross. O(n).
std::optional<bool> crosses_odd(std::span<const std::array<Rational3, 3>> triangles, const Rational3& from);

/// What is wrong with the proof that all positions near pose number `pose` are along its passage; nothing if they are.
std::optional<std::string> complaint_about_tight(const PathProof& proof, std::size_t pose);

/// What is wrong with the barrier of a proof, which must have one; nothing if no path of translations leads from the
/// first pose to the last. O(n log n) for n triangles.
std::optional<std::string> complaint_about_barrier(const PathProof& proof);

/// What is wrong with the boxes of poses of a proof, which must have some; nothing if no path of translations and
/// rotations about all axes leads from the first pose to the last. O(n) exact tests for n boxes, and one for each pair
/// of neighbours; `monitor` can stop it (Interrupted).
std::optional<std::string> complaint_about_cells(const PathProof& proof, const Monitor& monitor);

/// What is wrong with the layers of a proof, which must have some; nothing if no path of translations and rotations
/// along the claim's chain of arcs leads from the first pose to the last. O(n log n) exact tests for n triangles and
/// tetrahedra; `monitor` can stop it (Interrupted).
std::optional<std::string> complaint_about_layers(const PathProof& proof, const Monitor& monitor);

}  // namespace nef::planner
