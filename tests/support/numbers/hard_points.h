// SPDX-License-Identifier: Apache-2.0
//
// Points at which a set is hard to get right, and sets that are moved.
#pragma once

#include <vector>

#include "nef/polyhedron.h"

namespace nef::test {

/// The set moved by a vector.
inline Polyhedron moved(const Polyhedron& a, const Rational3& by) { return transform(a, AffineMap::translate(by)); }

/// The middle of some points.
inline Rational3 middle_of(const std::vector<Rational3>& points) {
  Rational3 middle;
  for (const Rational3& p : points) {
    for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i] / static_cast<unsigned long>(points.size());
  }
  return middle;
}

/// About `most` of each: vertices, middles between two vertices, middles of edges and of corners of facets.
inline std::vector<Rational3> hard_points(const Polyhedron& set, std::size_t most) {
  const Complex& c = set.complex();
  const auto vertex = [&](VertexId v) { return c.points.rational(point_of(v)); };
  std::vector<Rational3> points;
  const std::size_t vertices = c.vertex_count();
  for (std::size_t v = 0; v < vertices; v += 1 + vertices / most) {
    points.push_back(vertex(VertexId{v}));
    points.push_back(middle_of({vertex(VertexId{v}), vertex(VertexId{(v * 7 + 3) % vertices})}));
  }
  for (std::size_t h = 0; h < c.svertex_count(); h += 1 + c.svertex_count() / most) {
    const HalfedgeId halfedge{h};
    points.push_back(middle_of({vertex(c.source(halfedge)), vertex(c.target(halfedge))}));
  }
  for (std::size_t f = 0; f < c.facet_count(); f += 1 + c.facet_count() / most) {
    const auto corners = c.corners_of(c.facets[FacetId{static_cast<std::uint32_t>(f)}].first_cycle);
    if (corners.size() < 3) continue;
    const auto corner = [&](std::size_t k) { return vertex(c.shalfedge_vertex(corners[k])); };
    points.push_back(middle_of({corner(0), corner(1), corner(corners.size() / 2 + 1 - corners.size() % 2)}));
  }
  return points;
}

}  // namespace nef::test
