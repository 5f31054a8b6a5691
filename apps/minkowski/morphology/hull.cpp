// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "apps/minkowski/morphology.h"
#include "apps/minkowski/sum/cobounded_sum.h"
#include "apps/minkowski/sum/unbounded_sum.h"
#include "nef/construct/construct.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::minkowski {
namespace {

// The proper faces of largest dimension of a convex cell, as the points that span them.
std::vector<std::vector<Rational3>> facets_of(const ConvexCell& cell) {
  const std::vector<Rational3>& v = cell.mesh.vertices;
  std::vector<std::vector<Rational3>> result;
  if (cell.dimension == 1) return {{v[0]}, {v[1]}};
  for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
    const auto face = cell.mesh.face(f);
    std::vector<Rational3> ring;
    for (const std::uint32_t i : face) ring.push_back(v[i]);
    if (cell.dimension == 3) {
      result.push_back(std::move(ring));
      continue;
    }
    for (std::size_t k = 0; k < ring.size(); ++k) result.push_back({ring[k], ring[(k + 1) % ring.size()]});
  }
  return result;
}

// The hull of a closed set need not be closed: that of a line and a point is an open strip, the line and the point.
Polyhedron unbounded_hull(const Polyhedron& a, const Monitor& monitor) {
  const SpannedSet span = hull_span(a);
  std::vector<Polyhedron> parts = {to_polyhedron(span, false, monitor)};
  for (const Polyhedron& plane : border_planes(span, monitor)) {
    parts.push_back(hull(intersect(a, plane, monitor), monitor));
  }
  return unite_all(parts, monitor);
}

}  // namespace

// The relative interior of the closure's hull belongs to the hull of the set. What belongs of a face F of the closure's
// hull is the hull of what the set has in F.
Polyhedron hull(const Polyhedron& a, const Monitor& monitor) {
  if (a.is_empty()) return a;
  if (is_cobounded(a)) return Polyhedron::everything();
  if (!a.is_bounded()) return unbounded_hull(without_labels(a, monitor), monitor);
  const ConvexCell cell = hull_cell(a.complex().points.rationals(), monitor);
  if (cell.dimension == 0 || a.is_closed()) return to_polyhedron(cell, monitor);
  if (cell.dimension == 3 && a.is_open()) return to_polyhedron(opened(cell), monitor);
  std::vector<Polyhedron> parts = {to_polyhedron(opened(cell), monitor)};
  for (const std::vector<Rational3>& facet : facets_of(cell)) {
    parts.push_back(hull(intersect(a, convex_hull(facet, monitor), monitor), monitor));
  }
  return unite_all(parts, monitor);
}

std::optional<Rational> excess_of_hull(const Polyhedron& a, const Monitor& monitor) {
  if (!a.is_bounded() || a.is_empty()) return std::nullopt;
  const Polyhedron around = to_polyhedron(hull_cell(a.complex().points.rationals(), monitor), monitor);
  // Most sets are far from convex, which takes no exact volumes.
  const MeasuredVolume about = approximate_volume(a, monitor);
  const MeasuredVolume about_hull = approximate_volume(around, monitor);
  const double errors = about.error + about_hull.error;
  if (about_hull.value - about.value > 2 * errors + 1e-8 * about_hull.value) return std::nullopt;
  const std::optional<Rational> own = volume(a);
  const std::optional<Rational> of_hull = volume(around);
  if (!own || !of_hull || sgn(*of_hull) == 0) return std::nullopt;
  const Rational excess = (*of_hull - *own) / *of_hull;
  if (sgn(excess) == 0 || excess * 1000000000 > 1) return std::nullopt;
  return excess;
}

}  // namespace nef::minkowski
