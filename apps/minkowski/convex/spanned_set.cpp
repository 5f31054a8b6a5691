// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convex/spanned_set.h"

#include <algorithm>
#include <span>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/base/error.h"
#include "nef/construct/convex_hull.h"
#include "nef/construct/planar_hull.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

using nef::cross;
using nef::dot;
using nef::minus;

// Half-spaces n.x <= n.p and planes n.x = n.p whose intersection is the set; there are rays.
struct Constraint {
  Rational3 n, p;
  bool is_plane = false;
};

std::vector<Constraint> constraints_of(const SpannedSet& set, const Monitor& monitor) {
  std::vector<Constraint> result;
  const auto add = [&](const Rational3& n, const Rational3& p) {
    const auto leaves = [&](const Rational3& r) { return sgn(dot(n, r)) > 0; };
    if (std::none_of(set.rays.begin(), set.rays.end(), leaves)) result.push_back({n, p, false});
  };
  std::vector<Rational3> points = set.points;
  for (const Rational3& p : set.points) {
    for (const Rational3& r : set.rays) points.push_back(plus(p, r));
  }
  const Mesh mesh = hull_of(points, monitor).mesh;
  if (mesh.face_count() == 0) {
    NEF_ASSERT(mesh.vertices.size() == 2);
    const Rational3 d = minus(mesh.vertices[1], mesh.vertices[0]);
    const Rational3 n = across(d);
    result.push_back({n, mesh.vertices[0], true});
    result.push_back({cross(d, n), mesh.vertices[0], true});
    add(d, mesh.vertices[1]);
    add({Rational(-d[0]), Rational(-d[1]), Rational(-d[2])}, mesh.vertices[0]);
    return result;
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto corner = [&](std::size_t k) -> const Rational3& { return mesh.vertices[face[k % face.size()]]; };
    const Rational3 n = cross(minus(corner(1), corner(0)), minus(corner(2), corner(0)));
    if (mesh.face_count() > 1) {
      add(n, corner(0));
      continue;
    }
    result.push_back({n, corner(0), true});
    for (std::size_t k = 0; k < face.size(); ++k) add(cross(minus(corner(k + 1), corner(k)), n), corner(k));
  }
  return result;
}

Polyhedron plane_of(const Constraint& c, const Monitor& monitor) {
  return boundary(make_halfspace(c.n[0], c.n[1], c.n[2], Rational(-dot(c.n, c.p)), true, monitor), monitor);
}

}  // namespace

Polyhedron to_polyhedron(const SpannedSet& set, bool closed, const Monitor& monitor) {
  if (set.rays.empty()) {
    ConvexCell cell = hull_cell(set.points, monitor);
    return to_polyhedron(closed ? std::move(cell) : opened(std::move(cell)), monitor);
  }
  std::vector<Polyhedron> sets;
  for (const Constraint& c : constraints_of(set, monitor)) {
    sets.push_back(c.is_plane ? plane_of(c, monitor)
                              : make_halfspace(c.n[0], c.n[1], c.n[2], Rational(-dot(c.n, c.p)), closed, monitor));
  }
  return intersect_all(sets, monitor);
}

std::vector<Polyhedron> border_planes(const SpannedSet& set, const Monitor& monitor) {
  std::vector<Polyhedron> result;
  for (const Constraint& c : constraints_of(set, monitor)) {
    if (!c.is_plane) result.push_back(plane_of(c, monitor));
  }
  return result;
}

SpannedSet sum_of(const SpannedSet& a, const SpannedSet& b) {
  SpannedSet sum;
  for (const Rational3& p : a.points) {
    for (const Rational3& q : b.points) sum.points.push_back(plus(p, q));
  }
  sum.rays = a.rays;
  sum.rays.insert(sum.rays.end(), b.rays.begin(), b.rays.end());
  return sum;
}

}  // namespace nef::minkowski
