// SPDX-License-Identifier: Apache-2.0
//
// One number for every cell of a complex: its vertices, edges, facets and volumes. They are
// connected, relatively open and disjoint, and they fill space.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/complex/complex.h"

namespace nef::planner {

/// Index of a cell: vertices first, then edges, facets and volumes.
using CellId = std::uint32_t;
inline constexpr CellId kNoCell = 0xffffffffU;

/// Numbers the cells of a complex, which must outlive it. O(edges) to build.
class CellNumbering {
 public:
  explicit CellNumbering(const Complex& complex);

  [[nodiscard]] std::size_t size() const { return volumes_ + complex_->volume_count(); }

  [[nodiscard]] CellId vertex(VertexId v) const { return v.index(); }
  [[nodiscard]] CellId edge(HalfedgeId halfedge) const { return edges_ + edge_of_halfedge_[halfedge]; }
  [[nodiscard]] CellId facet(FacetId f) const { return facets_ + f.index(); }
  [[nodiscard]] CellId volume(VolumeId v) const { return volumes_ + v.index(); }

  /// 0 vertex, 1 edge, 2 facet, 3 volume.
  [[nodiscard]] int dimension(CellId cell) const {
    return cell < edges_ ? 0 : cell < facets_ ? 1 : cell < volumes_ ? 2 : 3;
  }
  /// Index of the vertex, edge, facet or volume in its own kind.
  [[nodiscard]] std::uint32_t index(CellId cell) const {
    return cell < edges_ ? cell : cell < facets_ ? cell - edges_ : cell < volumes_ ? cell - facets_ : cell - volumes_;
  }
  /// One of the two halfedges of an edge.
  [[nodiscard]] HalfedgeId halfedge(CellId edge) const { return halfedge_of_edge_[edge - edges_]; }

  /// The mark of a cell in the complex.
  [[nodiscard]] LabelId mark(CellId cell) const;

 private:
  const Complex* complex_;
  std::uint32_t edges_ = 0;
  std::uint32_t facets_ = 0;
  std::uint32_t volumes_ = 0;
  IndexedVector<HalfedgeId, std::uint32_t> edge_of_halfedge_;
  std::vector<HalfedgeId> halfedge_of_edge_;
};

}  // namespace nef::planner
