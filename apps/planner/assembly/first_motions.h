// SPDX-License-Identifier: Apache-2.0
//
// Directions that are in none of some open cones: in which parts can begin to move, for any number of contacts.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "apps/planner/assembly/contact_cones.h"
#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace nef::planner {

/// Rays that span a closed convex cone of directions, none of which is in one of the open cones; nothing if these cover
/// all directions, which is exact and complete. O(n) for n half-spaces; each cone of several normals is a choice
/// between them, so they take exponential time at worst.
std::optional<std::vector<Integer3>> free_cone(const std::set<OpenCone>& blocked, const Monitor& monitor = {});

/// Directions in none of the open cones, shorter vectors first: those along the rays of such cones, between them, and
/// along the axes. Nothing only if there are none; not all of them are listed, and no more than a few dozen.
std::vector<Rational3> free_ways(const std::set<OpenCone>& blocked, const Monitor& monitor = {});

}  // namespace nef::planner
