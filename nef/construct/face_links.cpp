// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/face_links.h"

#include <algorithm>

namespace nef {

// Svertex i leads along the side after corner i, and shalfedge 2 i is the half of its arc that leaves it. A facet is
// run around by those whose planes are not flipped.
void FaceLinks::note(const VertexRecord& record, std::span<const FaceCorner> ring, std::span<const PlaneId> planes) {
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    svertices_[ring[i].position] = record.svertices + i;
    shalfedges_[ring[i].position] = record.shalfedges + (2 * i + (planes[i].flipped() ? 1U : 0U));
  }
  noted_ += ring.size();
}

KnownLinks FaceLinks::links(const Complex& made, const SolidFaces& faces, std::span<const FaceCorner> corners,
                            std::span<const std::uint32_t> first) const {
  KnownLinks known;
  pair_edges(made, corners, first, known);
  list_facets(made, faces, known);
  return known;
}

void FaceLinks::pair_edges(const Complex& made, std::span<const FaceCorner> corners,
                           std::span<const std::uint32_t> first, KnownLinks& known) const {
  known.twin.assign(made.svertex_count(), HalfedgeId());
  std::size_t paired = 0;
  for (std::uint32_t v = 0; v + 1 < first.size(); ++v) {
    for (const FaceCorner& corner : corners.subspan(first[v], first[v + 1] - first[v])) {
      const std::uint32_t w = corner.next;
      const HalfedgeId there = svertices_[corner.position];
      if (w < v || !there.valid()) continue;
      // Plain vertices have one side to each neighbour.
      for (const FaceCorner& other : corners.subspan(first[w], first[w + 1] - first[w])) {
        if (other.next != v) continue;
        const HalfedgeId back = svertices_[other.position];
        if (!back.valid()) continue;
        known.twin[there] = back;
        known.twin[back] = there;
        paired += 2;
      }
    }
  }
  if (paired == made.svertex_count()) return;
  for (const VertexId v : made.vertex_ids()) {
    const IdRange<HalfedgeId> here = made.halfedges(v);
    if (std::any_of(here.begin(), here.end(), [&](HalfedgeId h) { return !known.twin[h].valid(); })) {
      known.loose_vertices.push_back(v);
    }
  }
}

void FaceLinks::list_facets(const Complex& made, const SolidFaces& faces, KnownLinks& known) const {
  known.facets.reserve(faces.plane.size());
  known.cycle_begin.reserve(faces.plane.size() + 1);
  known.corners.reserve(faces.corners.size());
  for (std::uint32_t f = 0; f < faces.plane.size(); ++f) {
    const auto ring = std::span(shalfedges_).subspan(faces.begin[f], faces.begin[f + 1] - faces.begin[f]);
    if (!std::all_of(ring.begin(), ring.end(), [](SHalfedgeId corner) { return corner.valid(); })) continue;
    const auto base = static_cast<std::ptrdiff_t>(known.corners.size());
    known.corners.insert(known.corners.end(), ring.begin(), ring.end());
    const auto cycle = known.corners.begin() + base;
    if (faces.plane[f].flipped()) std::reverse(cycle, known.corners.end());
    std::rotate(cycle, std::min_element(cycle, known.corners.end()), known.corners.end());
    Facet& facet = known.facets.emplace_back();
    facet.plane = made.shalfedge_plane[*cycle];
    facet.first_cycle = CycleId{known.cycle_begin.size() - 1};
    facet.cycle_count = 1;
    known.cycle_begin.push_back(static_cast<std::uint32_t>(known.corners.size()));
  }
  const auto row_less = [](const Facet& a, const Facet& b) { return a.plane.row() < b.plane.row(); };
  if (!std::is_sorted(known.facets.begin(), known.facets.end(), row_less)) {
    std::stable_sort(known.facets.begin(), known.facets.end(), row_less);
  }
  for (std::size_t i = 1; i < known.facets.size(); ++i) {
    const std::uint32_t row = known.facets[i].plane.row();
    if (known.facets[i - 1].plane.row() != row) continue;
    if (known.mixed_rows.empty() || known.mixed_rows.back() != row) known.mixed_rows.push_back(row);
  }
  if (2 * known.corners.size() == made.shalfedge_count() && made.sloops.empty()) return;
  std::vector<bool> is_known(made.shalfedge_count(), false);
  for (const SHalfedgeId corner : known.corners) is_known[corner.index()] = true;
  for (const SHalfedgeId e : made.shalfedge_ids()) {
    if (!is_known[e.index()] && !made.shalfedge_plane[e].flipped()) known.loose_corners.push_back(e);
  }
  for (const VertexId v : made.vertex_ids()) {
    if (made.vertices[v].sloops != made.vertices[v.next()].sloops) known.loose_isolated.push_back(v);
  }
}

}  // namespace nef
