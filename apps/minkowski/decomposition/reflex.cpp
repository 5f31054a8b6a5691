// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/decomposition/reflex.h"

namespace nef::minkowski {
namespace {

int oriented_sign(const Complex& complex, PlaneId plane, std::size_t axis) {
  const int sign = complex.planes.coefficient(plane, axis).sign();
  return plane.flipped() ? -sign : sign;
}

// Which of the directions -axis, +axis lie inside the wedge that begins at shalfedge `first` and
// takes more than a half-turn to `second`. The rest, from `second` on to `first`, is less than a
// half-turn: it is where the form of second's plane is >= 0 and that of first's is <= 0.
std::array<bool, 2> inside_wedge(const Complex& complex, const Direction& d, PlaneId first, PlaneId second,
                                 std::size_t axis, const Monitor& monitor) {
  std::array<bool, 2> inside{true, true};
  for (int k = 0; k < 2; ++k) {
    const int way = k == 0 ? -1 : 1;
    const auto i = static_cast<std::size_t>(k);
    if (first != second) {
      inside[i] = way * oriented_sign(complex, second, axis) < 0 || way * oriented_sign(complex, first, axis) > 0;
    } else if (oriented_sign(complex, first, axis) == 0) {
      // One facet only, and parallel to the axis: it leaves the edge along n x d.
      inside[i] =
          way * sign_of_determinant(along_axis(axis, 1), Direction::normal(complex.planes, first), d, monitor) < 0;
    }
  }
  return inside;
}

bool selected(LabelId label) { return (label & 1U) != 0 && label != kOutside; }

// A half-plane that leaves an edge of direction d = s e, e along the axis, on the oriented plane of a shalfedge there
// has direction n x d = s (n_y, -n_x, 0) if the axis is z. A wall that prolongs it goes the other way.
CrossWall prolonging(const Complex& complex, const Direction& d, PlaneId plane, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  const int up = sgn(d.integers()[axis]);
  const int leaves = cross_axis(complex, plane, axis) == x ? up * oriented_sign(complex, plane, y)
                                                           : -up * oriented_sign(complex, plane, x);
  return {plane, {leaves > 0, leaves < 0}};
}

}  // namespace

Direction along_axis(std::size_t axis, int way) {
  return Direction::exact(axis == 0 ? way : 0, axis == 1 ? way : 0, axis == 2 ? way : 0);
}

std::size_t cross_axis(const Complex& complex, PlaneId plane, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  return plane.valid() && complex.planes.coefficient(plane, y).sign() != 0 ? x : y;
}

std::vector<ReflexEdge> reflex_edges(const Complex& complex, std::size_t axis, const Monitor& monitor) {
  std::vector<ReflexEdge> result;
  for (const HalfedgeId h : complex.halfedge_ids()) {
    if (complex.twin[h] < h) continue;
    const SVertex& sv = complex.svertex(h);
    const VertexRecord& vertex = complex.vertices[complex.source(h)];
    const SphereMapView map = complex.sphere_map(complex.source(h));
    const Direction d = Direction::cross(complex.planes, sv.p, sv.q);
    ReflexEdge edge;
    edge.halfedge = h;
    edge.vertical = oriented_sign(complex, sv.p, axis) == 0 && oriented_sign(complex, sv.q, axis) == 0;
    if (sv.out == kNone) {
      const SFaceId sface = vertex.sfaces + sv.sface;
      if (!selected(map.sfaces[sv.sface].mark)) continue;
      edge.volume = complex.sface_volume(sface);
      edge.inside = {true, true};
      edge.cross_wall = {CrossWall{PlaneId(), {true, true}}, CrossWall{PlaneId(), {true, true}}};
      result.push_back(edge);
      continue;
    }
    std::uint32_t e = sv.out;
    do {
      const std::uint32_t next = map.next_around(e);
      const PlaneId first = map.shalfedges[e].plane;
      const PlaneId second = map.shalfedges[next].plane;
      const int turn = orientation_around(complex.planes, d, first, second, monitor);
      const bool reflex = turn < 0 || (turn == 0 && e == next);
      if (reflex && selected(map.sfaces[map.shalfedges[e].sface].mark)) {
        edge.volume = complex.sface_volume(vertex.sfaces + map.shalfedges[e].sface);
        if (edge.vertical) {
          edge.cross_wall = {prolonging(complex, d, first, axis), prolonging(complex, d, second, axis)};
        } else {
          edge.inside = inside_wedge(complex, d, first, second, axis, monitor);
        }
        result.push_back(edge);
      }
      e = next;
    } while (e != sv.out);
  }
  return result;
}

std::vector<VertexId> lonely_vertices(const Complex& complex) {
  std::vector<VertexId> result;
  for (const VertexId v : complex.vertex_ids()) {
    const SphereMapView map = complex.sphere_map(v);
    if (map.trivial() && selected(map.sfaces[0].mark)) result.push_back(v);
  }
  return result;
}

Direction cut_direction(const Complex& complex, PlaneId plane) {
  // n x z lies in the plane; n x y if the plane is horizontal.
  const Direction n = Direction::normal(complex.planes, PlaneId(plane.row() * 2U));
  const Direction g = Direction::cross(n, along_axis(2, 1));
  return g.is_zero() ? Direction::cross(n, along_axis(1, 1)) : g;
}

std::vector<ReflexCorner> reflex_corners(const Complex& complex, FacetId facet, const Monitor& monitor) {
  std::vector<ReflexCorner> result;
  const Facet& f = complex.facets[facet];
  const Direction g = cut_direction(complex, f.plane);
  const std::array<Direction, 2> way = {g.negated(), g};
  for (const VertexId v : complex.isolated_vertices_of(f)) {
    result.push_back({v, {true, true}});
  }
  for (const SHalfedgeId corner : complex.corners_of(f)) {
    const HalfedgeId forth = complex.corner_halfedge(corner);
    const HalfedgeId back = complex.corner_back_halfedge(corner);
    const auto direction = [&](HalfedgeId h) {
      return Direction::cross(complex.planes, complex.svertex(h).p, complex.svertex(h).q);
    };
    const Direction from = direction(forth);
    const Direction to = direction(back);
    ReflexCorner reflex{complex.shalfedge_vertex(corner), {true, true}};
    if (forth == back) {
      for (std::size_t k = 0; k < 2; ++k) reflex.inside[k] = !same_direction(from, way[k], monitor);
    } else if (orientation_on_circle(complex.planes, f.plane, from, to, monitor) < 0) {
      for (std::size_t k = 0; k < 2; ++k) {
        // The rest of the turn, from `to` on to `from`, is less than a half-turn.
        reflex.inside[k] = orientation_on_circle(complex.planes, f.plane, to, way[k], monitor) < 0 ||
                           orientation_on_circle(complex.planes, f.plane, way[k], from, monitor) < 0;
      }
    } else {
      continue;
    }
    result.push_back(reflex);
  }
  return result;
}

}  // namespace nef::minkowski
