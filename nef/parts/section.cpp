// SPDX-License-Identifier: Apache-2.0
#include "nef/parts/section.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"

namespace nef {
namespace {

// Reads polygons, segments and points off a closed set within a plane. In the closure nothing separates two parts of a
// polygon, so every facet is one polygon and every edge of a facet its border.
class SectionReader {
 public:
  SectionReader(const Complex& complex, const Rational3& normal, Section& out)
      : c_(complex), normal_(normal), out_(out) {}

  void run() {
    for (const Facet& facet : c_.facets) {
      if (is_selected(facet.mark)) add_polygon(facet);
    }
    for (const HalfedgeId h : c_.bare_edges()) {
      if (is_selected(c_.svertex(h).mark)) add_segment(h);
    }
    for (const VertexId v : c_.vertex_ids()) {
      if (c_.sphere_map(v).trivial()) out_.points.push_back(c_.points.rational(point_of(v)));
    }
  }

 private:
  void add_polygon(const Facet& facet) {
    if (!has_finite_corners(c_, facet)) {
      ++out_.unbounded;
      return;
    }
    // Cycles run counterclockwise as seen from the positive side of the unflipped plane.
    Rational along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += normal_[i] * Integer(c_.planes.coefficient(facet.plane, i));
    SectionPolygon polygon;
    for (const CycleId i : facet.cycles()) {
      std::vector<Rational3> ring;
      for (const SHalfedgeId corner : c_.corners_of(i)) {
        ring.push_back(c_.points.rational(point_of(c_.shalfedge_vertex(corner))));
      }
      if (along < 0) std::reverse(ring.begin(), ring.end());
      if (i == facet.first_cycle) {
        polygon.outer = std::move(ring);
      } else {
        polygon.holes.push_back(std::move(ring));
      }
    }
    out_.polygons.push_back(std::move(polygon));
  }

  void add_segment(HalfedgeId halfedge) {
    const VertexId u = c_.source(halfedge);
    const VertexId v = c_.target(halfedge);
    if (is_box_vertex(c_, u) || is_box_vertex(c_, v)) {
      ++out_.unbounded;
      return;
    }
    std::array<Rational3, 2> ends{c_.points.rational(point_of(u)), c_.points.rational(point_of(v))};
    if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
    out_.segments.push_back(std::move(ends));
  }

  const Complex& c_;
  const Rational3& normal_;
  Section& out_;
};

}  // namespace

Polyhedron plane_of_section(const Rational3& normal, const Rational& offset, const Monitor& monitor) {
  if (is_zero(normal)) throw InputError("the plane of a section needs a normal that is not (0,0,0)");
  return boundary(make_halfspace(normal[0], normal[1], normal[2], offset, true, monitor), monitor);
}

Section section(const Polyhedron& a, const Rational3& normal, const Rational& offset, const Monitor& monitor) {
  Section result;
  result.set = intersect(a, plane_of_section(normal, offset, monitor), monitor);
  const Polyhedron closed = closure(result.set, monitor);
  SectionReader(closed.complex(), normal, result).run();
  return result;
}

}  // namespace nef
