// SPDX-License-Identifier: Apache-2.0
//
// What several tests of the planner need.
#pragma once

#include <string>

#include "apps/planner/path/question.h"
#include "tests/support/oblique_rotation.h"
#include "tests/support/paths.h"

namespace nef::planner::test {

using nef::test::oblique_rotation;

/// a/b in lowest terms.
inline Rational ratio(long a, long b) {
  Rational result(a, b);
  result.canonicalize();
  return result;
}

/// A scene of data/planner, without its extension.
inline Scene load(const std::string& name) { return read_scene(source_folder() + "/data/planner/" + name + ".json"); }

/// The scene with obstacles, start and goal mapped by `map` and the robot by its linear part. Boxes are axis-parallel,
/// so the scene must have none.
Scene mapped(const Scene& scene, const AffineMap& map);

/// Component dimensions, largest first.
std::vector<int> component_dimensions(const FreeSpace& free);

/// An independent check of a path: no segment leaves the set (a Boolean of the core, not the planner's own query), and
/// the swept robot (an exact Minkowski sum) meets no obstacle in its interior. Returns what is wrong, or nothing.
std::string independent_complaint(const Scene& scene, const Polyhedron& free, const ExactPath& path, bool sweep);

}  // namespace nef::planner::test
