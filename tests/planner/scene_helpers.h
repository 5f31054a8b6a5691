// SPDX-License-Identifier: Apache-2.0
//
// What several tests of the planner need.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "apps/planner/path/question.h"
#include "tests/support/paths.h"
#include "tests/support/shapes/oblique_rotation.h"

namespace nef::planner::test {

using nef::test::oblique_rotation;

/// a/b in lowest terms.
inline Rational ratio(long a, long b) {
  Rational result(a, b);
  result.canonicalize();
  return result;
}

inline Rational3 scaled_by(const Rational& factor, const Rational3& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

/// Axes whose length is one, rational, and irrational.
const std::vector<Rational3>& turning_axes();

/// A scene of data/planner, without its extension.
inline Scene load(const std::string& name) { return read_scene(source_folder() + "/data/planner/" + name + ".json"); }

/// A scene in the words of a file.
inline Scene scene_of(const std::string& text) { return parse_scene(text, "", "test"); }

/// A scene in which a bar of length `length` and width 1 turns round the corner of a corridor of width 2. At 45 degrees
/// its outer side is half of its length away from the outer corner, so it fits iff length / 2 + 1 <= 2 sqrt(2): the
/// limit is 3.65685.
inline std::string corner(const std::string& length) {
  return R"J({"robot": "box(-)J" + length + R"J(/2,-1/2,0, )J" + length +
         R"J(/2,1/2,1)", "rotation": {"range": [0, 90]},
    "obstacles": ["box(-20,-20,-1, 20,20,2) - interior(box(-20,-2,-2, 0,0,3)) - interior(box(-2,-2,-2, 0,20,3))"],
    "box": [[-15,-15,0],[15,15,0]], "start": [-12,-1,0, 0], "goal": [-1,12,0, 90]})J";
}

/// A multiple of 1 / `denominator` from `low` to `high`.
Rational small_number(std::mt19937& random, int low, int high, int denominator);

/// A set of boxes, plates and points at small coordinates, so that nearly everything in it is degenerate, and points
/// from its surroundings.
Polyhedron degenerate_set(unsigned seed);
Rational3 point_near_degenerate_set(std::mt19937& random, int denominator);

/// The scene with obstacles, start and goal mapped by `map` and the robot by its linear part. Boxes are axis-parallel,
/// so the scene must have none.
Scene mapped(const Scene& scene, const AffineMap& map);

/// Component dimensions, largest first.
std::vector<int> component_dimensions(const FreeSpace& free);

/// An independent check of a path: no segment leaves the set (a Boolean of the core, not the planner's own query), and
/// the swept robot (an exact Minkowski sum) meets no obstacle in its interior. Returns what is wrong, or nothing.
std::string independent_complaint(const Scene& scene, const Polyhedron& free, const ExactPath& path, bool sweep);

/// How many random cases of a kind to try: `few`, times PLANNER_SEEDS in the environment, which .ci/run
/// asks for; a fifth of them under the sanitizers.
unsigned seeds(unsigned few);

}  // namespace nef::planner::test
