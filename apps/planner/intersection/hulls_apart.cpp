// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/intersection/hulls_apart.h"

#include <algorithm>

#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::planner {

std::vector<HalfSpace> half_spaces_of(const Mesh& polytope) {
  std::vector<HalfSpace> result;
  for (std::size_t f = 0; f < polytope.face_count(); ++f) {
    const auto ring = polytope.face(f);
    const Rational3& p = polytope.vertices[ring[0]];
    const Rational3 normal = cross(minus(polytope.vertices[ring[1]], p), minus(polytope.vertices[ring[2]], p));
    result.push_back({normal, dot(normal, p)});
  }
  return result;
}

bool hulls_are_apart(std::span<const Rational3> a, std::span<const Rational3> b, bool closed) {
  std::vector<Rational3> differences;
  for (const Rational3& p : a) {
    for (const Rational3& q : b) differences.push_back(minus(p, q));
  }
  const Hull hull = hull_of(differences);
  if (hull.dimension < 3) return !closed || !contains(convex_hull(hull.mesh.vertices), Rational3{});
  // The origin is on the outer side of a face, or on it.
  const std::vector<HalfSpace> faces = half_spaces_of(hull.mesh);
  return std::any_of(faces.begin(), faces.end(),
                     [closed](const HalfSpace& face) { return closed ? face.offset < 0 : face.offset <= 0; });
}

}  // namespace nef::planner
