// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/solid_links.h"

#include <algorithm>

#include "nef/base/error.h"

namespace nef {

SolidLinks::SolidLinks(const SolidFaces& faces)
    : faces_(faces), vertex_of_(faces.points.size()), shalfedge_of_(faces.corners.size()) {
  point_.reserve(faces.points.size());
  end_.reserve(faces.corners.size());
}

void SolidLinks::note(const Complex& result, std::uint32_t point, const Arrangement& drawing,
                      std::span<const std::uint32_t> ends, std::span<const std::uint32_t> corners) {
  if (note_drawn_ring(result, drawing, ends, corners)) {
    vertex_of_[point] = point_.end_id();
  } else {
    for (const std::uint32_t corner : corners) shalfedge_of_[corner] = SHalfedgeId();
    end_.resize(result.vertices[VertexId{result.vertex_count() - 1}].svertices.index());
    end_.resize(result.svertex_count(), kNone);
  }
  point_.push_back(point);
}

void SolidLinks::note_ring(const Complex& result, std::uint32_t point, std::span<const FaceCorner> ring) {
  SHalfedgeId shalfedge = result.vertices.shalfedges(VertexId{result.vertex_count() - 1});
  for (const FaceCorner& corner : ring) {
    end_.push_back(corner.next);
    shalfedge_of_[corner.at] = shalfedge + (faces_.plane[corner.face].flipped() ? 1U : 0U);
    shalfedge += 2;
  }
  vertex_of_[point] = point_.end_id();
  point_.push_back(point);
}

// Walks around the drawing as assemble_ring does: svertex i is the i-th node, shalfedge 2 i the half that leaves it.
bool SolidLinks::note_drawn_ring(const Complex& result, const Arrangement& drawing, std::span<const std::uint32_t> ends,
                                 std::span<const std::uint32_t> corners) {
  const VertexId vertex{result.vertex_count() - 1};
  const SphereMapView map = result.sphere_map(vertex);
  const auto n = static_cast<std::uint32_t>(drawing.nodes.size());
  if (drawing.arcs.size() != n || map.svertices.size() != n ||
      map.shalfedges.size() != 2 * static_cast<std::size_t>(n)) {
    return false;
  }
  const SHalfedgeId base = result.vertices.shalfedges(vertex);
  std::uint32_t half = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t node = drawing.source(half);
    const std::span<const std::uint32_t> two = drawing.around(drawing.target(half));
    if (two.size() != 2 || (i > 0 && half == 0) || map.shalfedges[2 * i].plane != drawing.plane(half)) return false;
    end_.push_back(ends[node]);
    shalfedge_of_[corners[half >> 1U]] = base + (2 * i + (drawing.plane(half).flipped() ? 1U : 0U));
    half = two[0] == (half ^ 1U) ? two[1] : two[0];
  }
  return half == 0;
}

std::optional<KnownLinks> SolidLinks::finish(const Complex& result) {
  NEF_ASSERT(point_.size() == result.vertex_count() && end_.size() == result.svertex_count());
  if (!every_plane_is_used(result)) return std::nullopt;
  KnownLinks links;
  link_twins(result, links);
  end_ = {};
  link_facets(result, links);
  return links;
}

bool SolidLinks::every_plane_is_used(const Complex& result) const {
  std::vector<bool> used(faces_.planes.size(), false);
  for (std::uint32_t f = 0; f < faces_.plane.size(); ++f) {
    const auto first = shalfedge_of_.begin() + faces_.begin[f];
    const auto last = shalfedge_of_.begin() + faces_.begin[f + 1];
    if (std::any_of(first, last, [](SHalfedgeId e) { return e.valid(); })) used[faces_.plane[f].row()] = true;
  }
  for (const VertexId v : result.vertex_ids()) {
    if (vertex_of_[point_[v]].valid()) continue;
    const SphereMapView map = result.sphere_map(v);
    for (const SVertex& s : map.svertices) used[s.p.row()] = used[s.q.row()] = true;
    for (const SHalfedge& e : map.shalfedges) used[e.plane.row()] = true;
    for (const SLoop& l : map.sloops) used[l.plane.row()] = true;
  }
  return std::find(used.begin(), used.end(), false) == used.end();
}

void SolidLinks::link_twins(const Complex& result, KnownLinks& links) const {
  links.twin.reserve(result.svertex_count());
  for (const VertexId v : result.vertex_ids()) {
    bool loose = false;
    for (const HalfedgeId s : result.halfedges(v)) {
      const VertexId w = end_[s] == kNone ? VertexId() : vertex_of_[end_[s]];
      HalfedgeId twin;
      if (w.valid()) {
        const IdRange<HalfedgeId> candidates = result.halfedges(w);
        const auto back = [&](HalfedgeId h) { return end_[h] == point_[v]; };
        const auto at = std::find_if(candidates.begin(), candidates.end(), back);
        if (at != candidates.end()) twin = *at;
      }
      links.twin.push_back(twin);
      loose = loose || !twin.valid();
    }
    if (loose) links.loose_vertices.push_back(v);
  }
}

void SolidLinks::link_facets(const Complex& result, KnownLinks& links) const {
  // By plane. A plane of several faces has facets in an order that synthesis knows, or holes.
  std::vector<std::uint32_t> begin(faces_.planes.size() + 1, 0);
  for (const PlaneId plane : faces_.plane) ++begin[plane.row() + 1];
  for (std::uint32_t row = 0; row + 1 < begin.size(); ++row) {
    if (begin[row + 1] > 1) links.mixed_rows.push_back(row);
    begin[row + 1] += begin[row];
  }
  std::vector<std::uint32_t> order(faces_.plane.size());
  for (std::uint32_t f = 0; f < order.size(); ++f) order[begin[faces_.plane[f].row()]++] = f;
  links.facets.reserve(order.size());
  links.cycle_begin.reserve(order.size() + 1);
  links.corners.reserve(faces_.corners.size());
  for (const std::uint32_t f : order) {
    if (!push_cycle(f, links)) continue;
    Facet facet;
    facet.plane = PlaneId{faces_.plane[f].row() << 1U};
    facet.first_cycle = CycleId{links.facets.size()};
    facet.cycle_count = 1;
    links.facets.push_back(facet);
    links.cycle_begin.push_back(static_cast<std::uint32_t>(links.corners.size()));
  }
  for (const VertexId v : result.vertex_ids()) {
    if (vertex_of_[point_[v]].valid()) continue;
    for (const SHalfedgeId e : result.shalfedges(v)) {
      if (!result.shalfedge_plane[e].flipped()) links.loose_corners.push_back(e);
    }
    if (result.vertices[v].sloops < result.vertices[v.next()].sloops) links.loose_isolated.push_back(v);
  }
  std::sort(links.loose_corners.begin(), links.loose_corners.end());
}

// From its smallest corner on. If not all corners are plain, those that are become loose.
bool SolidLinks::push_cycle(std::uint32_t face, KnownLinks& links) const {
  const std::span<const SHalfedgeId> ring =
      std::span(shalfedge_of_).subspan(faces_.begin[face], faces_.begin[face + 1] - faces_.begin[face]);
  if (std::find(ring.begin(), ring.end(), SHalfedgeId()) != ring.end()) {
    for (const SHalfedgeId e : ring) {
      if (e.valid()) links.loose_corners.push_back(e);
    }
    return false;
  }
  const auto n = ring.size();
  const auto least = static_cast<std::size_t>(std::min_element(ring.begin(), ring.end()) - ring.begin());
  const std::size_t step = faces_.plane[face].flipped() ? n - 1 : 1;
  for (std::size_t i = 0, k = least; i < n; ++i, k = (k + step) % n) links.corners.push_back(ring[k]);
  return true;
}

}  // namespace nef
