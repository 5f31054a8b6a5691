// SPDX-License-Identifier: Apache-2.0
//
// Volumes are sorted into selected (bounded), unselected, and those that no mesh holds; the facets between a selected
// volume and any other are the boundary. The vertices of these facets get numbers, in their order. Where these are all
// that there are, as in most sets, no numbers are made.
#include "nef/export/exported_parts.h"

#include "nef/base/error.h"

namespace nef {

ExportedParts::ExportedParts(const Complex& complex, const MeshExportOptions& options)
    : complex_(complex), options_(options), volumes_(complex.volume_count()) {
  classify_volumes();
  collect_facets();
  if (facets_.empty() && options_.lower_dimensional) collect_lower_dimensional();
  number_vertices();
}

// A selected volume is unbounded if it is the outer one, or has a facet on an infimaximal box.
void ExportedParts::classify_volumes() {
  IndexedVector<VolumeId, bool> unbounded(volumes_.size(), false);
  if (!unbounded.empty()) unbounded[kOuterVolume] = true;
  if (complex_.has_box()) {
    for (const Facet& facet : complex_.facets) {
      if (!complex_.planes.infimaximal(facet.plane)) continue;
      unbounded[facet.volume_above] = true;
      unbounded[facet.volume_below] = true;
    }
  }
  for (const VolumeId v : volumes_.ids()) {
    const LabelId mark = complex_.volumes[v].mark;
    if (mark == kOutside) {
      volumes_[v].other = true;
    } else if (!is_selected(mark)) {
      volumes_[v].unselected = true;
    } else if (unbounded[v]) {
      volumes_[v].other = true;
      ++unbounded_count_;
    } else {
      volumes_[v].selected = true;
    }
  }
}

void ExportedParts::collect_facets() {
  for (const FacetSides& sides : complex_.facets.kinds()) {
    const bool above = volumes_[sides.volume_above].selected;
    kinds_.push_back({above != volumes_[sides.volume_below].selected, above});
  }
  facets_.reserve(complex_.facet_count());
  for (const FacetId f : complex_.facets.ids()) {
    if (kinds_[complex_.facets.kind(f)].is_boundary) facets_.push_back(f);
  }
}

// Of a set without solid parts: facets, edges outside of these, and vertices outside of all these.
void ExportedParts::collect_lower_dimensional() {
  IndexedVector<VertexId, bool> held(complex_.vertex_count(), false);
  IndexedVector<HalfedgeId, bool> in_facet(complex_.svertex_count(), false);
  for (const FacetId f : complex_.facets.ids()) {
    const Facet& facet = complex_.facets[f];
    if (!is_selected(facet.mark) || sees_other(facet)) continue;
    facets_.push_back(f);
    for (const SHalfedgeId corner : complex_.corners_of(facet)) {
      const HalfedgeId h = complex_.corner_halfedge(corner);
      in_facet[h] = in_facet[complex_.twin[h]] = true;
      held[complex_.shalfedge_vertex(corner)] = true;
    }
    for (const VertexId v : complex_.isolated_vertices_of(facet)) {
      held[v] = true;
    }
  }
  for (const HalfedgeId h : complex_.halfedge_ids()) {
    const VertexId v = complex_.source(h);
    const VertexId w = complex_.target(h);
    if (in_facet[h] || h > complex_.twin[h] || !is_selected(complex_.svertex(h).mark)) continue;
    if (!finite(v) || !finite(w) || sides_of_edge(v, h).selected) continue;
    lines_.push_back({v, w});
    held[v] = held[w] = true;
  }
  for (const VertexId v : complex_.vertex_ids()) {
    if (!held[v] && finite(v) && is_selected(complex_.mark(v))) points_.push_back(v);
  }
  lower_dimensional_ = !facets_.empty() || !lines_.empty() || !points_.empty();
}

// A volume on a side of the facet is lost as a whole.
bool ExportedParts::sees_other(const Facet& facet) const {
  if (volumes_[facet.volume_above].other || volumes_[facet.volume_below].other) return true;
  for (const SHalfedgeId corner : complex_.corners_of(facet)) {
    if (!finite(complex_.shalfedge_vertex(corner))) return true;
  }
  return false;
}

// Every vertex with an arc is a corner of a facet, as each arc is one corner.
bool ExportedParts::has_all_vertices() const {
  if (!has_all_facets() || 2 * complex_.corners.size() != complex_.shalfedge_count()) return false;
  for (std::uint32_t i = 0; i < complex_.patterns.size(); ++i) {
    if (complex_.patterns.shalfedges(PatternId{i}).empty()) return false;
  }
  return true;
}

// Vertices keep their order; only those of the boundary get a number.
void ExportedParts::number_vertices() {
  if (has_all_vertices()) {
    places_.reserve(complex_.vertex_count());
    for (const VertexId v : complex_.vertex_ids()) places_.push_back(point_of(v));
    return;
  }
  number_.assign(complex_.vertex_count(), kUnused);
  for (const auto& [v, w] : lines_) number_[v] = number_[w] = 0;
  for (const VertexId v : points_) number_[v] = 0;
  for (const FacetId f : facets_) {
    for (const SHalfedgeId corner : complex_.corners_of(f)) number_[complex_.shalfedge_vertex(corner)] = 0;
  }
  for (const VertexId v : number_.ids()) {
    if (number_[v] == kUnused) continue;
    NEF_ASSERT(finite(v));
    number_[v] = static_cast<std::uint32_t>(places_.size());
    places_.push_back(point_of(v));
  }
}

SeenVolumes ExportedParts::sides_of_edge(VertexId vertex, HalfedgeId halfedge) const {
  const SphereMapView map = complex_.sphere_map(vertex);
  const VertexRecord& record = complex_.vertices[vertex];
  const SVertex& svertex = complex_.svertex(halfedge);
  if (svertex.out == kNone) return volumes_[complex_.sface_volume(record.sfaces + svertex.sface)];
  SeenVolumes sides;
  std::uint32_t e = svertex.out;
  do {
    sides.add(volumes_[complex_.sface_volume(record.sfaces + map.shalfedges[e].sface)]);
    e = map.next_around(e);
  } while (e != svertex.out);
  return sides;
}

}  // namespace nef
