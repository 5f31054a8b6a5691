// SPDX-License-Identifier: Apache-2.0
//
// Convex polytopes cut by half-spaces.
#pragma once

#include <optional>

#include "nef/mesh/mesh.h"

namespace nef::planner {

/// What a convex solid has in the half-space normal * x <= offset, as a mesh without coplanar faces if `solid` has
/// none; nothing unless it is a solid. O(n).
std::optional<Mesh> clipped(Mesh solid, const Rational3& normal, const Rational& offset);

}  // namespace nef::planner
