// SPDX-License-Identifier: Apache-2.0
//
// A direction of the robot has images: for each direction of an obstacle, the two vectors along it that are as long as
// the robot's. Two directions of the robot and an image of each are joined by a rotation if the scalar products are the
// same; doubles rule most of them out.
#include "apps/planner/orientation/aligned_rotations.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/planner/orientation/rotations.h"
#include "nef/complex/complex.h"
#include "nef/geometry/vectors.h"
#include "nef/number/square_root.h"

namespace nef::planner {
namespace {

// A vector, and near its direction.
struct Arm {
  Rational3 exact;
  Double3 unit;
};

Arm arm_along(const Integer3& v, const Rational& scale) {
  const Rational3 exact{scale * v[0], scale * v[1], scale * v[2]};
  Double3 rough{nearest_double(exact[0]), nearest_double(exact[1]), nearest_double(exact[2])};
  const double length = std::sqrt(dot(rough, rough));
  for (double& x : rough) x /= length;
  return {exact, rough};
}

struct RobotDirection {
  Arm arm;
  std::vector<Arm> images;
};

RobotDirection with_images(const Integer3& direction, const std::set<Integer3>& of_obstacles) {
  RobotDirection result{arm_along(direction, 1), {}};
  for (const Integer3& to : of_obstacles) {
    const std::optional<Rational> scale =
        rational_square_root(Rational(dot(direction, direction)) / Rational(dot(to, to)));
    if (!scale) continue;
    for (const int sign : {1, -1}) result.images.push_back(arm_along(to, sign * *scale));
  }
  return result;
}

// The rotation that takes a to c and b to d, where a and b are not parallel, and lengths and angles fit. Its matrix is
// that of c, d, c x d times the inverse of that of a, b, a x b.
Quaternion rotation_of_frames(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) {
  const Rational3 n = cross(a, b);
  const std::array<Rational3, 3> to{c, d, cross(c, d)};
  const std::array<Rational3, 3> inverse{cross(b, n), cross(n, a), n};
  const Rational scale = dot(n, n);  // what the product is multiplied by
  const auto entry = [&](std::size_t i, std::size_t j) -> Rational {
    return to[0][i] * inverse[0][j] + to[1][i] * inverse[1][j] + to[2][i] * inverse[2][j];
  };
  const Rational w = scale + entry(0, 0) + entry(1, 1) + entry(2, 2);
  if (w != 0) return {w, entry(2, 1) - entry(1, 2), entry(0, 2) - entry(2, 0), entry(1, 0) - entry(0, 1)};
  // A half turn: its matrix and the identity add up to twice the projection onto the axis.
  for (std::size_t j = 0; j < 3; ++j) {
    Quaternion q{0, entry(0, j), entry(1, j), entry(2, j)};
    q[j + 1] += scale;
    if (q[j + 1] != 0) return q;
  }
  return {1, 0, 0, 0};  // no matrix of a rotation comes here
}

void add_rotations(const RobotDirection& a, const RobotDirection& b, std::set<Quaternion>& rotations) {
  constexpr double kFar = 1e-9;  // doubles are off by less than a millionth of that
  const double wanted = dot(a.arm.unit, b.arm.unit);
  for (const Arm& c : a.images) {
    for (const Arm& d : b.images) {
      if (std::fabs(dot(c.unit, d.unit) - wanted) > kFar) continue;
      if (dot(c.exact, d.exact) != dot(a.arm.exact, b.arm.exact)) continue;
      rotations.insert(canonical(rotation_of_frames(a.arm.exact, b.arm.exact, c.exact, d.exact)));
    }
  }
}

}  // namespace

std::set<Integer3> face_directions(std::span<const Polyhedron> sets) {
  std::set<Integer3> result;
  for (const Polyhedron& set : sets) {
    const Complex& c = set.complex();
    for (const Facet& facet : c.facets) {
      if (c.planes.infimaximal(facet.plane)) continue;
      Integer3 normal;
      for (std::size_t k = 0; k < 3; ++k) normal[k] = Integer(mpz_srcptr(c.planes.coefficient(facet.plane, k)));
      normal = primitive(std::move(normal));
      result.insert(std::max(normal, opposite(normal)));
    }
  }
  return result;
}

std::set<Quaternion> aligned_rotations(const std::set<Integer3>& of_robot, const std::set<Integer3>& of_obstacles,
                                       const Monitor& monitor) {
  std::vector<RobotDirection> directions;
  for (const Integer3& direction : of_robot) directions.push_back(with_images(direction, of_obstacles));
  std::set<Quaternion> rotations;
  for (std::size_t j = 1; j < directions.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      monitor.check_interruption();
      add_rotations(directions[i], directions[j], rotations);
    }
  }
  return rotations;
}

}  // namespace nef::planner
