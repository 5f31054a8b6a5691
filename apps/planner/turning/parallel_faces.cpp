// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_cells.h"

#include <algorithm>

#include "nef/complex/complex.h"
#include "nef/geometry/vectors.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

// Equal for vectors across the axis of one direction, and for those along it.
Rational3 normalized(const Rational3& v, const TurningAxis& axis) {
  Rational3 across = axis.across(v);
  Rational size;
  for (const Rational& x : across) size = std::max(size, Rational(abs(x)));
  if (size == 0) return across;
  for (Rational& x : across) x /= size;
  return across;
}

std::set<Rational3> normals_of(const std::vector<Polyhedron>& obstacles, const TurningAxis& axis) {
  std::set<Rational3> result;
  for (const Polyhedron& obstacle : obstacles) {
    const Complex& c = obstacle.complex();
    for (const Facet& facet : c.facets) {
      if (c.planes.infimaximal(facet.plane)) continue;
      Rational3 n;
      for (std::size_t k = 0; k < 3; ++k) {
        n[k] = Rational(mpz_class(mpz_srcptr(c.planes.coefficient(facet.plane, k))));
      }
      result.insert(normalized(n, axis));
    }
  }
  return result;
}

std::set<Rational3> normals_of(const TurningRobot& robot) {
  std::set<Rational3> result;
  for (const TurningRobot::Piece& piece : robot.pieces()) {
    for (const HalfSpace& face : piece.faces) result.insert(normalized(face.normal, robot.axis()));
  }
  return result;
}

}  // namespace

std::set<Turn> turns_of_parallel_faces(const Scene& scene, const TurningRobot& robot, const TurningQuestion& question,
                                       const Monitor& monitor) {
  std::set<Turn> turns;
  const std::set<Rational3> of_obstacles = normals_of(scene.obstacles, question.axis);
  for (const Rational3& n : normals_of(robot)) {
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
