// SPDX-License-Identifier: Apache-2.0
//
// An operand of a Boolean operation as the operation sees it: its complex with all planes and
// points renamed to common tables.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/complex/facet_plane.h"
#include "nef/complex/item_ref.h"
#include "nef/geometry/search/box_tree.h"

namespace nef {

/// Planes and points of both operands and of what the operation adds. Those of the first operand keep their names; the
/// points of the second one follow them.
struct CommonTables {
  PlaneTable planes;
  PointTable points;
  std::vector<std::uint32_t> rows_of_second;  ///< the row of each plane of the second operand
  std::array<Box, 2> bounds;                  ///< of the vertices of each operand

  /// O(planes and points), on the threads of `monitor`.
  CommonTables(const Complex& first, const Complex& second, const Monitor& monitor);
};

class Operand {
 public:
  /// Operand `x` (0 or 1) of those whose tables these are; both must outlive the operand.
  Operand(const Complex& complex, const CommonTables& tables, std::size_t x);
  Operand(const Operand&) = delete;
  Operand& operator=(const Operand&) = delete;

  [[nodiscard]] const Complex& complex() const { return *complex_; }
  [[nodiscard]] PlaneId plane(PlaneId own) const { return rows_.empty() ? own : own.in_row(rows_[own.row()]); }
  [[nodiscard]] PointId point(VertexId vertex) const { return point_of(vertex) + first_point_; }
  [[nodiscard]] SVertex svertex(HalfedgeId halfedge) const {
    SVertex result = complex_->svertex(halfedge);
    result.p = plane(result.p);
    result.q = plane(result.q);
    return result;
  }
  [[nodiscard]] PlaneId facet_plane(FacetId facet) const { return plane(complex_->facets[facet].plane); }

  /// The smaller halfedge of an edge.
  [[nodiscard]] HalfedgeId edge(HalfedgeId halfedge) const { return complex_->edge(halfedge); }
  [[nodiscard]] VertexId source(HalfedgeId halfedge) const { return complex_->source(halfedge); }
  [[nodiscard]] VertexId target(HalfedgeId halfedge) const { return complex_->target(halfedge); }

  [[nodiscard]] const Box& bounds() const { return *bounds_; }
  [[nodiscard]] Box vertex_box(VertexId vertex) const;
  [[nodiscard]] Box edge_box(HalfedgeId halfedge) const;
  [[nodiscard]] Box facet_box(FacetId facet) const;

  /// The plane other than `plane` (a common name) that holds the edge, and the side of it to the
  /// left of the halfedge in `plane`. See edge_side in nef/complex/facet_plane.h.
  [[nodiscard]] EdgeSide edge_side(const PlaneTable& planes, PlaneId plane, HalfedgeId halfedge,
                                   const Monitor& monitor) const {
    return nef::edge_side(planes, plane, svertex(halfedge), monitor);
  }

  /// The local pyramid at an item; the whole-space one of `label` for no item. `scratch` may hold it.
  SphereMapView pyramid(const ItemRef& item, LabelId label, SphereMapBuffer& scratch) const;

  /// The mark of the volume that `direction` leads into from a point on `item`. It must not lead
  /// along a lower-dimensional item.
  [[nodiscard]] LabelId volume_mark(const PlaneTable& planes, const ItemRef& item, const Direction& direction,
                                    const Monitor& monitor) const;

 private:
  void rename(SphereMapBuffer& map) const;

  const Complex* complex_;
  std::span<const std::uint32_t> rows_;  // own plane row -> common row; empty for the first operand
  std::uint32_t first_point_ = 0;
  const Box* bounds_;
};

}  // namespace nef
