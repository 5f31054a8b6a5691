// SPDX-License-Identifier: Apache-2.0
//
// All items are looked at for what the mesh does not say of the set. A vertex with the same pattern that sees the same
// volumes as the last one has the same losses, which makes this a few comparisons a vertex.
#include "nef/export/lost_features.h"

#include <algorithm>
#include <vector>

namespace nef {
namespace {

class LostFeatures {
 public:
  explicit LostFeatures(const ExportedParts& parts)
      : parts_(parts), complex_(parts.complex()), volumes_(parts.volumes()) {}

  MeshLosses find() {
    losses_.volumes = parts_.unbounded_count();
    look_for_losses();
    if (parts_.lower_dimensional()) count_open_borders();
    return losses_;
  }

 private:
  // Sorts items by what their mark and the volumes around them say about the mesh.
  void judge(const SeenVolumes& sides, LabelId mark, std::size_t ItemCounts::*member, std::size_t count,
             MeshLosses& to) const {
    const bool selected = parts_.is_selected(mark);
    if (sides.selected && !selected) {
      ItemCounts& items = sides.unselected || sides.other ? to.open : to.cracks;
      items.*member += count;
    }
    if (!sides.selected && !sides.other && selected && !parts_.lower_dimensional()) to.flat.*member += count;
  }

  // Few sets have facets that are lost.
  void look_for_lost_facets() {
    const std::span<const FacetSides> kinds = complex_.facets.kinds();
    std::vector<MeshLosses> of_kind(kinds.size());
    bool any = false;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      SeenVolumes sides = volumes_[kinds[i].volume_above];
      sides.add(volumes_[kinds[i].volume_below]);
      judge(sides, kinds[i].mark, &ItemCounts::facets, 1, of_kind[i]);
      any = any || of_kind[i].flat.any() || of_kind[i].open.any() || of_kind[i].cracks.any();
    }
    if (!any) return;
    for (const FacetId f : complex_.facets.ids()) losses_ += of_kind[complex_.facets.kind(f)];
  }

  void look_for_losses() {
    look_for_lost_facets();
    // Then whatever lies in the closure of a facet sees a volume of the mesh, and is lost only if it is not selected.
    const bool all_facets = parts_.has_all_facets() && !parts_.lower_dimensional();
    const std::vector<bool> keeps_all = all_facets ? whole_patterns() : std::vector<bool>(complex_.patterns.size());
    if (std::find(keeps_all.begin(), keeps_all.end(), false) == keeps_all.end()) return;
    // What a vertex and the ends of edges there add is the same for those that have a pattern and see the same volumes.
    struct Known {
      std::vector<SeenVolumes> seen;  // by each sface
      MeshLosses losses;
    };
    std::vector<Known> known(complex_.patterns.size());
    std::vector<SeenVolumes> seen;
    MeshLosses ends;
    for (const VertexId v : complex_.vertex_ids()) {
      const std::uint32_t pattern = complex_.vertices.pattern(v).index();
      if (keeps_all[pattern] || !parts_.finite(v)) continue;
      seen.clear();
      for (const SFaceId s : complex_.sfaces(v)) seen.push_back(volumes_[complex_.sface_volume(s)]);
      Known& here = known[pattern];
      // With a box, the other ends of edges matter, too.
      if (complex_.has_box() || here.seen != seen) here = {seen, losses_at(v, seen, all_facets)};
      ends += here.losses;
    }
    for (ItemCounts* items : {&ends.flat, &ends.open, &ends.cracks}) items->edges /= 2;
    losses_ += ends;
  }

  // Of a vertex and its edges, which count once for each end. `seen`: by each of its sfaces.
  [[nodiscard]] MeshLosses losses_at(VertexId v, const std::vector<SeenVolumes>& seen, bool all_facets) const {
    MeshLosses losses;
    const SphereMapView map = complex_.sphere_map(v);
    const bool at_facet = all_facets && !(map.shalfedges.empty() && map.sloops.empty());
    if (!at_facet || !parts_.is_selected(map.mark)) {
      SeenVolumes sides;
      for (const SeenVolumes& volume : seen) sides.add(volume);
      judge(sides, map.mark, &ItemCounts::vertices, 1, losses);
    }
    for (const HalfedgeId h : complex_.halfedges(v)) {
      const SVertex& svertex = complex_.svertex(h);
      if (all_facets && svertex.out != kNone && parts_.is_selected(svertex.mark)) continue;
      judge(parts_.sides_of_edge(v, h), svertex.mark, &ItemCounts::edges, parts_.finite(complex_.target(h)) ? 1 : 2,
            losses);
    }
    return losses;
  }

  // Of each pattern: its vertices and all their edges are selected, and lie in facets.
  [[nodiscard]] std::vector<bool> whole_patterns() const {
    std::vector<bool> result;
    for (std::uint32_t i = 0; i < complex_.patterns.size(); ++i) {
      const SphereMapView map = complex_.patterns.view(PatternId{i});
      const auto is_whole = [&](const SVertex& s) { return s.out != kNone && parts_.is_selected(s.mark); };
      result.push_back(!map.shalfedges.empty() && parts_.is_selected(map.mark) &&
                       std::all_of(map.svertices.begin(), map.svertices.end(), is_whole));
    }
    return result;
  }

  // Edges and vertices of the facets that are written and do not belong to the set.
  void count_open_borders() {
    IndexedVector<HalfedgeId, bool> seen_edge(complex_.svertex_count(), false);
    IndexedVector<VertexId, bool> seen_vertex(complex_.vertex_count(), false);
    for (const FacetId f : parts_.facets()) {
      for (const SHalfedgeId corner : complex_.corners_of(f)) {
        const VertexId v = complex_.shalfedge_vertex(corner);
        const HalfedgeId h = complex_.corner_halfedge(corner);
        if (!seen_vertex[v] && !parts_.is_selected(complex_.mark(v))) ++losses_.open.vertices;
        if (!seen_edge[h] && !parts_.is_selected(complex_.svertex(h).mark)) ++losses_.open.edges;
        seen_vertex[v] = true;
        seen_edge[h] = seen_edge[complex_.twin[h]] = true;
      }
    }
  }

  const ExportedParts& parts_;
  const Complex& complex_;
  const IndexedVector<VolumeId, SeenVolumes>& volumes_;
  MeshLosses losses_;
};

}  // namespace

MeshLosses lost_features(const ExportedParts& parts) { return LostFeatures(parts).find(); }

}  // namespace nef
