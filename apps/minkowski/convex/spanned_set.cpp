// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convex/spanned_set.h"

#include <algorithm>
#include <span>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/base/error.h"
#include "nef/construct/convex_hull.h"
#include "nef/construct/planar_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {
namespace {

using nef::cross;
using nef::dot;
using nef::minus;

Rational3 plus(const Rational3& a, const Rational3& b) {
  return {Rational(a[0] + b[0]), Rational(a[1] + b[1]), Rational(a[2] + b[2])};
}

// The half-spaces n.x <= n.p that hold the set, collected.
class Constraints {
 public:
  Constraints(std::span<const Rational3> rays, bool closed) : rays_(rays), closed_(closed) {}

  // Keeps the half-space unless a ray leaves it.
  void add(const Rational3& n, const Rational3& p) {
    if (std::any_of(rays_.begin(), rays_.end(), [&](const Rational3& r) { return sgn(dot(n, r)) > 0; })) return;
    sets_.push_back(make_halfspace(n[0], n[1], n[2], Rational(-dot(n, p)), closed_));
  }
  // The plane n.x = n.p.
  void add_plane(const Rational3& n, const Rational3& p) {
    sets_.push_back(boundary(make_halfspace(n[0], n[1], n[2], Rational(-dot(n, p)))));
  }
  [[nodiscard]] Polyhedron meet() const { return intersect_all(sets_); }

 private:
  std::span<const Rational3> rays_;
  bool closed_;
  std::vector<Polyhedron> sets_;
};

// A vector that is not parallel to d.
Rational3 across(const Rational3& d) {
  return d[0] == 0 && d[1] == 0 ? Rational3{1, 0, 0} : Rational3{Rational(-d[1]), d[0], 0};
}

}  // namespace

Polyhedron to_polyhedron(const SpannedSet& set, bool closed) {
  if (set.rays.empty()) {
    ConvexCell cell = hull_cell(set.points);
    return to_polyhedron(closed ? std::move(cell) : opened(std::move(cell)));
  }
  std::vector<Rational3> points = set.points;
  for (const Rational3& p : set.points) {
    for (const Rational3& r : set.rays) points.push_back(plus(p, r));
  }
  const Mesh mesh = hull_of(points).mesh;
  Constraints constraints(set.rays, closed);
  if (mesh.face_count() == 0) {
    NEF_ASSERT(mesh.vertices.size() == 2);
    const Rational3 d = minus(mesh.vertices[1], mesh.vertices[0]);
    const Rational3 n = across(d);
    constraints.add_plane(n, mesh.vertices[0]);
    constraints.add_plane(cross(d, n), mesh.vertices[0]);
    constraints.add(d, mesh.vertices[1]);
    constraints.add({Rational(-d[0]), Rational(-d[1]), Rational(-d[2])}, mesh.vertices[0]);
    return constraints.meet();
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto corner = [&](std::size_t k) -> const Rational3& { return mesh.vertices[face[k % face.size()]]; };
    const Rational3 n = cross(minus(corner(1), corner(0)), minus(corner(2), corner(0)));
    if (mesh.face_count() > 1) {
      constraints.add(n, corner(0));
      continue;
    }
    constraints.add_plane(n, corner(0));
    for (std::size_t k = 0; k < face.size(); ++k) {
      constraints.add(cross(minus(corner(k + 1), corner(k)), n), corner(k));
    }
  }
  return constraints.meet();
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
