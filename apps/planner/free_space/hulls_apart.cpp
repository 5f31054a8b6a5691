// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/hulls_apart.h"

#include <vector>

#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::planner {

bool hulls_are_apart(std::span<const Rational3> a, std::span<const Rational3> b, bool closed) {
  std::vector<Rational3> differences;
  for (const Rational3& p : a) {
    for (const Rational3& q : b) differences.push_back(minus(p, q));
  }
  const Hull hull = hull_of(differences);
  if (hull.dimension < 3) return !closed || !contains(convex_hull(hull.mesh.vertices), Rational3{});
  // The origin is on the outer side of a face, or on it.
  for (std::size_t f = 0; f < hull.mesh.face_count(); ++f) {
    const auto ring = hull.mesh.face(f);
    const Rational3& p = hull.mesh.vertices[ring[0]];
    const Rational3 normal = cross(minus(hull.mesh.vertices[ring[1]], p), minus(hull.mesh.vertices[ring[2]], p));
    const Rational beyond = -dot(normal, p);
    if (beyond > 0 || (beyond == 0 && !closed)) return true;
  }
  return false;
}

}  // namespace nef::planner
