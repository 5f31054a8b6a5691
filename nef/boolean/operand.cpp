// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/operand.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/complex/item_boxes.h"
#include "nef/complex/local_pyramid.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

CommonTables::CommonTables(const Complex& first, const Complex& second, const Monitor& monitor) {
  const auto find_planes = [&](const Monitor& own) { rows_of_second = first.planes.rows_of(second.planes, own); };
  const auto copy = [&](const Monitor&) {
    planes.reserve(first.planes.size() + second.planes.size(), first.planes.limbs() + second.planes.limbs());
    planes.append_new(first.planes, 0, first.planes.size());
    points.reserve(first.points.size() + second.points.size(), first.points.limbs() + second.points.limbs());
    points.append(first.points, 0, first.points.size());
    points.append(second.points, 0, second.points.size());
  };
  const auto find_bounds = [&](const Monitor&) {
    for (std::size_t x = 0; x < 2; ++x) {
      const Complex& complex = x == 0 ? first : second;
      for (const VertexId v : complex.vertex_ids()) {
        bounds[x].add_rounded(complex.points.approximate(point_of(v)));
      }
    }
  };
  parallel_calls(monitor, {find_planes, copy, find_bounds});
  planes.append_missing(second.planes, rows_of_second);
}

Operand::Operand(const Complex& complex, const CommonTables& tables, std::size_t x)
    : complex_(&complex),
      rows_(x == 0 ? std::span<const std::uint32_t>() : tables.rows_of_second),
      first_point_(x == 0 ? 0 : static_cast<std::uint32_t>(tables.points.size() - complex.points.size())),
      bounds_(&tables.bounds[x]) {}

void Operand::rename(SphereMapBuffer& map) const {
  if (rows_.empty()) return;
  for_each_plane(map, [this](PlaneId& own) { own = plane(own); });
}

Box Operand::vertex_box(VertexId vertex) const { return nef::vertex_box(*complex_, vertex); }

Box Operand::edge_box(HalfedgeId halfedge) const { return nef::edge_box(*complex_, halfedge); }

Box Operand::facet_box(FacetId facet) const { return nef::facet_box(*complex_, complex_->facets[facet]); }

SphereMapView Operand::pyramid(const ItemRef& item, LabelId label, SphereMapBuffer& scratch) const {
  if (!item.valid()) {
    scratch.assign_trivial(label);
    return scratch.view();
  }
  if (item.kind == ItemRef::Kind::kVertex && rows_.empty()) return complex_->sphere_map(item.vertex());
  pyramid_of(*complex_, item, scratch);
  rename(scratch);
  return scratch.view();
}

LabelId Operand::volume_mark(const PlaneTable& planes, const ItemRef& item, const Direction& direction,
                             const Monitor& monitor) const {
  SphereMapBuffer scratch;
  const SphereMapView map = pyramid(item, 0, scratch);
  const SphereLocation where = locate(planes, map, direction, monitor);
  NEF_ASSERT(where.kind == SphereLocation::Kind::kSFace);
  return map.sfaces[where.index].mark;
}

}  // namespace nef
