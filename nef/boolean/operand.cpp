// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/operand.h"

#include "nef/base/error.h"
#include "nef/complex/item_boxes.h"
#include "nef/complex/local_pyramid.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

Operand::Operand(const Complex& complex, CommonTables& tables)
    : complex_(&complex), first_point_(static_cast<std::uint32_t>(tables.points.size())) {
  if (tables.planes.size() == 0 && tables.points.size() == 0) {
    tables.planes = complex.planes;
    tables.points = complex.points;
  } else {
    tables.points.append(complex.points, 0, complex.points.size());
    rows_.resize(complex.planes.size());
    tables.planes.reserve(tables.planes.size() + complex.planes.size());
    for (std::uint32_t row = 0; row < rows_.size(); ++row) {
      rows_[row] = tables.planes.intern_from(complex.planes, PlaneId{row << 1U}).row();
    }
  }
  for (std::uint32_t v = 0; v < complex.vertex_count(); ++v) {
    bounds_.add_rounded(complex.points.approximate(PointId{v}));
  }
}

void Operand::rename(SphereMapBuffer& map) const {
  if (rows_.empty()) return;
  for_each_plane(map, [this](PlaneId& own) { own = plane(own); });
}

Box Operand::vertex_box(std::uint32_t vertex) const { return nef::vertex_box(*complex_, vertex); }

Box Operand::edge_box(std::uint32_t halfedge) const { return nef::edge_box(*complex_, halfedge); }

Box Operand::facet_box(FacetId facet) const { return nef::facet_box(*complex_, complex_->facets[facet]); }

SphereMapView Operand::pyramid(const Item& item, LabelId label, SphereMapBuffer& scratch) const {
  switch (item.kind) {
    case Item::Kind::kVertex: {
      const SphereMapView map = complex_->sphere_map(item.index);
      if (rows_.empty()) return map;
      scratch.assign(map);
      rename(scratch);
      break;
    }
    case Item::Kind::kEdge: {
      const std::uint32_t vertex = source(item.index);
      edge_pyramid(complex_->sphere_map(vertex), item.index - complex_->vertices[vertex].svertices, scratch);
      rename(scratch);
      break;
    }
    case Item::Kind::kFacet: {
      const Facet& facet = complex_->facets[item.facet()];
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
