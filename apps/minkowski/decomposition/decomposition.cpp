// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/decomposition/decomposition.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "apps/minkowski/decomposition/cell_reader.h"
#include "apps/minkowski/decomposition/reflex.h"
#include "apps/minkowski/decomposition/wall_axis.h"
#include "apps/minkowski/decomposition/walls.h"
#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

void require_bounded(const Polyhedron& a, const char* what) {
  if (a.is_bounded()) return;
  throw UnsupportedError(
      std::string(what) +
      " is unbounded, so it is not a union of finitely many convex polytopes; intersect it with a box first");
}

std::vector<ConvexCell> decompose(const Polyhedron& a, const Monitor& monitor) {
  require_bounded(a, "the set to decompose");
  const Polyhedron set = without_labels(a, monitor);
  return decompose_along(set, wall_axis(set.complex(), monitor), monitor);
}

std::vector<ConvexCell> decompose_along(const Polyhedron& a, std::size_t axis, const Monitor& monitor) {
  require_bounded(a, "the set to decompose");
  Polyhedron walled = erect_walls(a, axis, monitor);
  {
    CellReader reader(walled.complex(), monitor);
    std::vector<ConvexCell> cells = reader.solids();
    const std::vector<FacetId> to_cut = reader.facets_to_cut();
    if (to_cut.empty()) {
      std::vector<ConvexCell> flat = reader.flat_cells();
      std::move(flat.begin(), flat.end(), std::back_inserter(cells));
      return cells;
    }
    walled = cut_facets(walled, to_cut, monitor);
  }
  CellReader reader(walled.complex(), monitor);
  std::vector<ConvexCell> cells = reader.solids();
  NEF_ASSERT(reader.facets_to_cut().empty());
  std::vector<ConvexCell> flat = reader.flat_cells();
  std::move(flat.begin(), flat.end(), std::back_inserter(cells));
  return cells;
}

std::vector<ConvexCell> decompose_open(const Polyhedron& a, const Monitor& monitor) {
  require_bounded(a, "the set to decompose");
  const Polyhedron walled = erect_walls(a, wall_axis(a.complex(), monitor), monitor);
  return CellReader(walled.complex(), monitor).open_solids();
}

bool is_full_dimensional(const Polyhedron& a) { return is_full_dimensional_set(a.complex()); }

bool is_point(const Polyhedron& a) {
  const Complex& c = a.complex();
  return c.vertex_count() == 1 && c.svertex_count() == 0 && c.sloops.empty() && c.mark(VertexId{0}) == 1 &&
         c.volumes[kOuterVolume].mark == 0;
}

Polyhedron negate(const Polyhedron& a, const Monitor& monitor) {
  return transform(a, AffineMap::scale({Rational(-1), Rational(-1), Rational(-1)}), monitor);
}

namespace {

// Convex iff the relative interior of the hull belongs to the set (its closure does not exceed the
// hull) and what belongs to each facet of the hull is convex: of two points not in a common facet,
// all between them is inside. A closed set with the interior of the hull is the hull, and an open one is that interior:
// their facets need not be looked at one by one, which takes O(n) each.
bool is_convex_set(const Polyhedron& a, const Monitor& monitor) {
  const std::vector<Rational3> points = a.complex().points.rationals();
  if (points.empty()) return true;
  const ConvexCell hull = hull_cell(points, monitor);
  if (!subtract(to_polyhedron(opened(hull), monitor), a, monitor).is_empty()) return false;
  if (hull.dimension < 2 || a.is_closed() || a.is_open()) return true;
  for (std::size_t f = 0; f < hull.mesh.face_count(); ++f) {
    const auto face = hull.mesh.face(f);
    const std::size_t sides = hull.dimension == 3 ? 1 : face.size();
    for (std::size_t k = 0; k < sides; ++k) {
      std::vector<Rational3> part;
      for (std::size_t i = 0; i < (hull.dimension == 3 ? face.size() : 2); ++i) {
        part.push_back(hull.mesh.vertices[face[(k + i) % face.size()]]);
      }
      if (!is_convex_set(intersect(a, convex_hull(part, monitor), monitor), monitor)) return false;
    }
  }
  return true;
}

}  // namespace

bool is_convex(const Polyhedron& a, const Monitor& monitor) {
  require_bounded(a, "the set");
  const Polyhedron set = without_labels(a, monitor);
  if (set.is_empty() || is_point(set)) return true;
  // A volume that takes more than a half-turn about an edge is not all around it.
  if (!reflex_edges(set.complex(), 0, monitor).empty()) return false;
  // A closed set with reflex edges would be cut into several solids; asking is cheaper than cutting.
  return is_convex_set(set, monitor);
}

}  // namespace nef::minkowski
