// SPDX-License-Identifier: Apache-2.0
//
// The box of a scene, where nobody gives one.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/cones/cone.h"

namespace nef::visual_hull {

/// A half-space normal . x + offset >= 0.
using HalfSpace = RationalPlane;

/// The planes of the convex hull of a cone: one per edge of the silhouette's convex hull.
std::vector<HalfSpace> convex_cone(const Camera& camera, const Silhouette& silhouette,
                                   const nef::Monitor& monitor = {});

/// What is known of the intersection of half-spaces.
struct Bounds {
  enum class Kind { kBox, kEmpty, kUnbounded };
  Kind kind = Kind::kBox;
  WorldBox box;  ///< the smallest box around it, exact
};

/// The smallest box around the intersection of half-spaces, by six linear programs (Seidel's incremental algorithm,
/// expected O(n) each, in a fixed order of the constraints): in doubles, where the vertex found is then proven to be
/// allowed and best in rationals, else in rationals from the start. Exact either way.
Bounds bounds_of(const std::vector<HalfSpace>& half_spaces);

/// A box with short numbers that contains `box` in its interior, larger by about a hundredth.
WorldBox loosen(const WorldBox& box);

}  // namespace nef::visual_hull
