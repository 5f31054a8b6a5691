// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/item_boxes.h"

namespace nef {

Box vertex_box(const Complex& complex, VertexId vertex) {
  Box box;
  box.add_rounded(complex.points.approximate(point_of(vertex)));
  return box;
}

Box edge_box(const Complex& complex, HalfedgeId halfedge) {
  Box box = vertex_box(complex, complex.source(halfedge));
  box.add_rounded(complex.points.approximate(point_of(complex.target(halfedge))));
  return box;
}

Box facet_box(const Complex& complex, const Facet& facet) {
  Box box;
  // The first cycle is the outer one.
  for (const SHalfedgeId corner : complex.corners_of(facet.first_cycle)) {
    box.add_rounded(complex.points.approximate(point_of(complex.shalfedge_vertex(corner))));
  }
  return box;
}

Box vertices_box(const Complex& complex) {
  Box box;
  for (const VertexId v : complex.vertex_ids()) box.add_rounded(complex.points.approximate(point_of(v)));
  return box;
}

}  // namespace nef
