// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_cells.h"

#include <algorithm>

#include "apps/planner/orientation/aligned_rotations.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

// The parts of directions across an axis, those of one direction once.
std::set<Rational3> across_axis(const std::set<Integer3>& directions, const TurningAxis& axis) {
  std::set<Rational3> result;
  for (const Integer3& direction : directions) {
    Rational3 across = axis.across(to_rational(direction));
    Rational size;
    for (const Rational& x : across) size = std::max(size, Rational(abs(x)));
    if (size == 0) continue;
    for (Rational& x : across) x /= size;
    result.insert(across);
  }
  return result;
}

}  // namespace

std::set<Turn> turns_of_parallel_faces(const Scene& scene, const TurningQuestion& question, const Monitor& monitor) {
  std::set<Turn> turns;
  const std::set<Rational3> of_obstacles = across_axis(face_directions(scene.obstacles), question.axis);
  for (const Rational3& n : across_axis(face_directions({&scene.robot, 1}), question.axis)) {
    for (const Rational3& m : of_obstacles) {
      monitor.check_interruption();
      // The angle from n to m or its opposite, since facets have two sides; in the range, which may begin anywhere.
      for (const Rational3& to : {m, opposite(m)}) {
        const std::optional<Turn> turn = question.axis.turn_between(n, to);
        if (!turn) break;
        for (Turn at = moved_above(*turn, question.low); at <= question.high; at += 4) {
          turns.insert(at);
        }
      }
    }
  }
  return turns;
}

}  // namespace nef::planner
