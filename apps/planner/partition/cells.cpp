// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/partition/cells.h"

namespace nef::planner {

CellNumbering::CellNumbering(const Complex& complex) : complex_(&complex) {
  edge_of_halfedge_.resize(complex.svertex_count());
  for (const HalfedgeId h : complex.halfedge_ids()) {
    if (complex.twin[h] < h) continue;
    const auto edge = static_cast<std::uint32_t>(halfedge_of_edge_.size());
    edge_of_halfedge_[h] = edge;
    edge_of_halfedge_[complex.twin[h]] = edge;
    halfedge_of_edge_.push_back(h);
  }
  edges_ = static_cast<std::uint32_t>(complex.vertex_count());
  facets_ = edges_ + static_cast<std::uint32_t>(halfedge_of_edge_.size());
  volumes_ = facets_ + static_cast<std::uint32_t>(complex.facet_count());
}

LabelId CellNumbering::mark(CellId cell) const {
  const std::uint32_t i = index(cell);
  switch (dimension(cell)) {
    case 0:
      return complex_->mark(VertexId{i});
    case 1:
      return complex_->svertex(halfedge_of_edge_[i]).mark;
    case 2:
      return complex_->facets[FacetId{i}].mark;
    default:
      return complex_->volumes[VolumeId{i}].mark;
  }
}

}  // namespace nef::planner
