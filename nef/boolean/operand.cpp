// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/operand.h"

#include "nef/base/error.h"
#include "nef/complex/local_pyramid.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

Operand::Operand(const Complex& complex, CommonTables& tables)
    : complex_(&complex),
      first_point_(static_cast<std::uint32_t>(tables.points.size())),
      svertices_(complex.svertices),
      shalfedges_(complex.shalfedges),
      sloops_(complex.sloops) {
  if (tables.planes.size() == 0 && tables.points.size() == 0) {
    tables.planes = complex.planes;
    tables.points = complex.points;
  } else {
    tables.points.append(complex.points);
    rows_.resize(complex.planes.size());
    tables.planes.reserve(tables.planes.size() + complex.planes.size());
    for (std::uint32_t row = 0; row < rows_.size(); ++row) {
      rows_[row] = tables.planes.intern_from(complex.planes, PlaneId{row << 1U}).row();
    }
    renamed_svertices_ = complex.svertices;
    for (SVertex& v : renamed_svertices_) {
      v.p = plane(v.p);
      v.q = plane(v.q);
    }
    renamed_shalfedges_ = complex.shalfedges;
    for (SHalfedge& e : renamed_shalfedges_) e.plane = plane(e.plane);
    renamed_sloops_ = complex.sloops;
    for (SLoop& l : renamed_sloops_) l.plane = plane(l.plane);
    svertices_ = renamed_svertices_;
    shalfedges_ = renamed_shalfedges_;
    sloops_ = renamed_sloops_;
  }
  for (std::uint32_t v = 0; v < complex.vertex_count(); ++v) {
    bounds_.add_rounded(complex.points.approximate(PointId{v}));
  }
}

SphereMapView Operand::sphere_map(std::uint32_t vertex) const {
  const VertexRecord& first = complex_->vertices[vertex];
  const VertexRecord& last = complex_->vertices[vertex + 1];
  SphereMapView map = complex_->sphere_map(vertex);
  map.svertices = svertices_.subspan(first.svertices, last.svertices - first.svertices);
  map.shalfedges = shalfedges_.subspan(first.shalfedges, last.shalfedges - first.shalfedges);
  map.sloops = sloops_.subspan(first.sloops, last.sloops - first.sloops);
  return map;
}

Box Operand::vertex_box(std::uint32_t vertex) const {
  Box box;
  box.add_rounded(complex_->points.approximate(PointId{vertex}));
  return box;
}

Box Operand::edge_box(std::uint32_t halfedge) const {
  Box box;
  box.add_rounded(complex_->points.approximate(PointId{source(halfedge)}));
  box.add_rounded(complex_->points.approximate(PointId{target(halfedge)}));
  return box;
}

Box Operand::facet_box(std::uint32_t facet) const {
  Box box;
  for (const std::uint32_t corner : complex_->cycle(complex_->facets[facet].first_cycle)) {
    box.add_rounded(complex_->points.approximate(PointId{complex_->shalfedge_owner[corner]}));
  }
  return box;
}

SphereMapView Operand::pyramid(const Item& item, LabelId label, SphereMapBuffer& scratch) const {
  switch (item.kind) {
    case Item::Kind::kVertex:
      return sphere_map(item.index);
    case Item::Kind::kEdge: {
      const std::uint32_t vertex = source(item.index);
      edge_pyramid(sphere_map(vertex), item.index - complex_->vertices[vertex].svertices, scratch);
      break;
    }
    case Item::Kind::kFacet: {
      const Facet& facet = complex_->facets[item.index];
      scratch.assign_circle(plane(facet.plane), facet.mark, complex_->volumes[facet.volume_above].mark,
                            complex_->volumes[facet.volume_below].mark);
      break;
    }
    case Item::Kind::kNone:
      scratch.assign_trivial(label);
      break;
  }
  return scratch.view();
}

LabelId Operand::volume_mark(const PlaneTable& planes, const Item& item, const Direction& direction) const {
  SphereMapBuffer scratch;
  const SphereMapView map = pyramid(item, 0, scratch);
  const SphereLocation where = locate(planes, map, direction);
  NEF_ASSERT(where.kind == SphereLocation::Kind::kSFace);
  return map.sfaces[where.index].mark;
}

}  // namespace nef
