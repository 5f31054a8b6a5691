// SPDX-License-Identifier: Apache-2.0
//
// Which parts of a complex a mesh has, and the numbers of its vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/complex/complex.h"
#include "nef/export/mesh_losses.h"
#include "nef/export/to_mesh.h"

namespace nef {

/// The facets between the selected volumes and all others, and their vertices; of a set without solid parts, if the
/// options ask for it, its selected facets, the edges outside of these, and the vertices outside of all these.
class ExportedParts {
 public:
  /// Both must outlive this object. O(n).
  ExportedParts(const Complex& complex, const MeshExportOptions& options);

  [[nodiscard]] const Complex& complex() const { return complex_; }

  /// True if what has this mark belongs to the set.
  [[nodiscard]] bool is_selected(LabelId mark) const {
    if (mark == kOutside) return false;
    return options_.selected ? options_.selected(mark) : mark != 0;
  }
  /// False for the vertices of the infimaximal box.
  [[nodiscard]] bool finite(VertexId vertex) const {
    return !complex_.has_box() || complex_.points.finite(point_of(vertex));
  }

  /// What each volume is to the mesh.
  [[nodiscard]] const IndexedVector<VolumeId, SeenVolumes>& volumes() const { return volumes_; }
  /// How many volumes are selected, but not in the mesh, as they are unbounded.
  [[nodiscard]] std::size_t unbounded_count() const { return unbounded_count_; }

  /// The facets that the mesh has.
  [[nodiscard]] std::span<const FacetId> facets() const { return facets_; }
  /// True if these are all of the complex.
  [[nodiscard]] bool has_all_facets() const { return facets_.size() == complex_.facet_count(); }
  /// True if the solid lies above such a facet.
  [[nodiscard]] bool is_below(FacetId facet) const { return kinds_[complex_.facets.kind(facet)].is_below; }

  /// True for parts of a set without solid parts.
  [[nodiscard]] bool lower_dimensional() const { return lower_dimensional_; }
  /// Edges and vertices of such a set.
  [[nodiscard]] std::span<const std::array<VertexId, 2>> lines() const { return lines_; }
  [[nodiscard]] std::span<const VertexId> points() const { return points_; }

  /// Where the vertices of the mesh lie. They have the order of the complex's.
  [[nodiscard]] std::span<const PointId> places() const { return places_; }
  static constexpr std::uint32_t kUnused = 0xffffffffU;  ///< stands for no vertex of the mesh
  /// The vertex of the mesh that a vertex of the complex is; kUnused if it is none.
  [[nodiscard]] std::uint32_t number(VertexId v) const { return number_.empty() ? v.index() : number_[v]; }
  /// The same of the vertex at a corner of a facet.
  [[nodiscard]] std::uint32_t number(SHalfedgeId corner) const { return number(complex_.shalfedge_vertex(corner)); }

  /// The volumes around an edge that leaves a vertex.
  [[nodiscard]] SeenVolumes sides_of_edge(VertexId vertex, HalfedgeId halfedge) const;

 private:
  // What facets of one mark between the same volumes are.
  struct FacetKind {
    bool is_boundary = false;
    bool is_below = false;  // the solid lies above
  };

  void classify_volumes();
  void collect_facets();
  void collect_lower_dimensional();
  [[nodiscard]] bool sees_other(const Facet& facet) const;
  [[nodiscard]] bool has_all_vertices() const;
  void number_vertices();

  const Complex& complex_;
  const MeshExportOptions& options_;
  IndexedVector<VolumeId, SeenVolumes> volumes_;
  std::size_t unbounded_count_ = 0;
  std::vector<FacetKind> kinds_;
  std::vector<FacetId> facets_;
  bool lower_dimensional_ = false;
  std::vector<std::array<VertexId, 2>> lines_;
  std::vector<VertexId> points_;
  IndexedVector<VertexId, std::uint32_t> number_;  // empty: their own
  std::vector<PointId> places_;
};

}  // namespace nef
