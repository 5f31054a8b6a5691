// SPDX-License-Identifier: Apache-2.0
//
// Reads marked convex cells off a complex whose selected volumes are convex (see walls.h).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "apps/minkowski/decomposition/cell_body.h"
#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef::minkowski {

/// Collects cells whose union is the set of points with a selected label. A cell takes the faces
/// of its boundary with it if they are selected whole, and with all larger faces around them;
/// selected items that no cell took become cells of their own, largest first.
class CellReader {
 public:
  /// The complex must outlive the reader.
  CellReader(const Complex& complex, const Monitor& monitor);

  /// The cells of dimension 3 with their marks; closed ones are merged where their union is convex. To be
  /// called first.
  std::vector<ConvexCell> solids();

  /// The insides of cells whose union is dense in the selected volumes, merged even across facets that are not
  /// selected: enough for sums that only need open solids (see minkowski_sum.cpp). Cheaper.
  std::vector<ConvexCell> open_solids();

  /// Selected facets that no solid took and that are not convex: cut them and start over.
  [[nodiscard]] std::vector<FacetId> facets_to_cut() const;

  /// The cells of dimension 2, 1, 0 for what is left. To be called last.
  std::vector<ConvexCell> flat_cells();

 private:
  struct Carriers;

  [[nodiscard]] bool selected(LabelId label) const;
  void collect_items(VolumeId volume);
  CellBody body();
  void count_planes(std::span<const FacetId> by_plane);
  [[nodiscard]] std::vector<VertexId> outline(std::span<const FacetId> facets) const;
  void set_boundary(ConvexCell& cell);
  void set_marks(ConvexCell& cell);
  Carriers carriers(const ConvexCell& cell) const;
  void take_all();
  ConvexCell polygon(FacetId facet);
  ConvexCell segment(HalfedgeId halfedge);

  const Complex& complex_;
  Monitor monitor_;
  IndexedVector<VolumeId, std::vector<FacetId>> facets_of_volume_;
  IndexedVector<FacetId, std::uint8_t> facet_taken_;
  IndexedVector<HalfedgeId, std::uint8_t> halfedge_taken_;
  IndexedVector<VertexId, std::uint8_t> vertex_taken_;

  // The volume at hand and the items on its boundary.
  VolumeId volume_ = kOuterVolume;
  std::vector<FacetId> facets_;
  std::vector<HalfedgeId> halfedges_;
  std::vector<VertexId> vertices_;
  IndexedVector<HalfedgeId, std::uint32_t> seen_halfedge_;
  IndexedVector<VertexId, std::uint32_t> seen_vertex_, local_;
  std::vector<std::uint32_t> planes_at_;  // per vertex of the volume
  std::uint32_t turn_ = 0;
};

}  // namespace nef::minkowski
