// SPDX-License-Identifier: Apache-2.0
//
// First each corner is told its items, then each vertex pairs its edges with those of its neighbours, then each face
// lists its facet. Corners, edges and faces are written by one thread each, whichever it is.
#include "nef/construct/face_links.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "nef/base/threads/parallel.h"

namespace nef {
namespace {

constexpr std::size_t kBlock = 4096;

class FaceLinks {
 public:
  FaceLinks(const Complex& made, const PlainVertices& plain, const Monitor& monitor)
      : made_(made),
        plain_(plain),
        monitor_(for_vertices(made.vertex_count(), monitor)),
        shalfedges_(plain.corners.size()) {}

  KnownLinks run() {
    for_points([this](std::uint32_t v) { note(v); });
    pair_edges();
    list_facets();
    sort_facets();
    list_loose_corners();
    return std::move(known_);
  }

 private:
  // Facets of consecutive faces.
  struct Facets {
    std::vector<Facet> facets;
    std::vector<std::uint32_t> ends{0};  // of their cycles, behind 0
    std::vector<SHalfedgeId> corners;
  };

  [[nodiscard]] std::span<const FaceCorner> corners_of(std::uint32_t v) const {
    return plain_.corners.subspan(plain_.first[v], plain_.first[v + 1] - plain_.first[v]);
  }

  template <typename Body>
  void for_points(const Body& body) const {
    parallel_for_ranges(plain_.made.size(), kBlock, monitor_, [&](std::size_t first, std::size_t last, const Monitor&) {
      for (auto v = static_cast<std::uint32_t>(first); v < last; ++v) body(v);
    });
  }

  void note(std::uint32_t v);
  std::size_t pair_edges_of(std::uint32_t v);
  void pair_edges();
  void list_facets();
  void list_facet(std::uint32_t face, Facets& out) const;
  void join(Facets&& block);
  void sort_facets();
  void list_loose_corners();

  const Complex& made_;
  const PlainVertices& plain_;
  Monitor monitor_;
  // Of each corner, in the order of the faces, the one that runs around the facet of the face; not valid if the corner
  // is at no plain vertex.
  std::vector<SHalfedgeId> shalfedges_;
  KnownLinks known_;
};

// Shalfedge 2 i is the half of corner i's arc that leaves its svertex. A facet is run around by those whose planes are
// not flipped.
void FaceLinks::note(std::uint32_t v) {
  if (!plain_.made[v].valid()) return;
  SHalfedgeId leaving = made_.vertices[plain_.made[v]].shalfedges;
  for (const FaceCorner& corner : corners_of(v)) {
    shalfedges_[corner.position] = leaving + (plain_.faces.plane[corner.face].flipped() ? 1U : 0U);
    leaving = leaving + 2;
  }
}

// Svertex i leads along the side after corner i. Plain vertices have one side to each neighbour.
std::size_t FaceLinks::pair_edges_of(std::uint32_t v) {
  if (!plain_.made[v].valid()) return 0;
  std::size_t paired = 0;
  HalfedgeId there = made_.vertices[plain_.made[v]].svertices;
  for (const FaceCorner& corner : corners_of(v)) {
    const std::uint32_t w = corner.next;
    if (w > v && plain_.made[w].valid()) {
      HalfedgeId back = made_.vertices[plain_.made[w]].svertices;
      for (const FaceCorner& other : corners_of(w)) {
        if (other.next == v) {
          known_.twin[there] = back;
          known_.twin[back] = there;
          paired += 2;
        }
        back = back + 1;
      }
    }
    there = there + 1;
  }
  return paired;
}

void FaceLinks::pair_edges() {
  known_.twin.assign(made_.svertex_count(), HalfedgeId());
  std::atomic<std::size_t> paired = 0;
  parallel_for_ranges(plain_.made.size(), kBlock, monitor_, [&](std::size_t first, std::size_t last, const Monitor&) {
    std::size_t here = 0;
    for (auto v = static_cast<std::uint32_t>(first); v < last; ++v) here += pair_edges_of(v);
    paired += here;
  });
  if (paired == made_.svertex_count()) return;
  for (const VertexId v : made_.vertex_ids()) {
    const IdRange<HalfedgeId> here = made_.halfedges(v);
    if (std::any_of(here.begin(), here.end(), [&](HalfedgeId h) { return !known_.twin[h].valid(); })) {
      known_.loose_vertices.push_back(v);
    }
  }
}

void FaceLinks::list_facets() {
  const auto list = [this](std::size_t first, std::size_t last, const Monitor&) {
    Facets block;
    block.facets.reserve(last - first);
    block.ends.reserve(last - first + 1);
    block.corners.reserve(plain_.faces.begin[last] - plain_.faces.begin[first]);
    for (auto f = static_cast<std::uint32_t>(first); f < last; ++f) list_facet(f, block);
    return block;
  };
  for (Facets& block : blocks_of(plain_.faces.plane.size(), kBlock, monitor_, list)) join(std::move(block));
}

void FaceLinks::list_facet(std::uint32_t face, Facets& out) const {
  const SolidFaces& faces = plain_.faces;
  const auto ring = std::span(shalfedges_).subspan(faces.begin[face], faces.begin[face + 1] - faces.begin[face]);
  if (!std::all_of(ring.begin(), ring.end(), [](SHalfedgeId corner) { return corner.valid(); })) return;
  const auto base = static_cast<std::ptrdiff_t>(out.corners.size());
  out.corners.insert(out.corners.end(), ring.begin(), ring.end());
  const auto cycle = out.corners.begin() + base;
  if (faces.plane[face].flipped()) std::reverse(cycle, out.corners.end());
  std::rotate(cycle, std::min_element(cycle, out.corners.end()), out.corners.end());
  Facet& facet = out.facets.emplace_back();
  facet.plane = made_.shalfedge_plane[*cycle];
  facet.first_cycle = CycleId{out.facets.size() - 1};
  facet.cycle_count = 1;
  out.ends.push_back(static_cast<std::uint32_t>(out.corners.size()));
}

void FaceLinks::join(Facets&& block) {
  if (known_.facets.empty()) {
    known_.facets = std::move(block.facets);
    known_.cycle_begin = IndexedVector<CycleId, std::uint32_t>(std::move(block.ends));
    known_.corners = std::move(block.corners);
    known_.facets.reserve(plain_.faces.plane.size());
    known_.cycle_begin.reserve(plain_.faces.plane.size() + 1);
    known_.corners.reserve(plain_.faces.corners.size());
    return;
  }
  const auto cycles = static_cast<std::uint32_t>(known_.facets.size());
  const auto corners = static_cast<std::uint32_t>(known_.corners.size());
  for (Facet& facet : block.facets) {
    facet.first_cycle = CycleId{facet.first_cycle.index() + cycles};
    known_.facets.push_back(facet);
  }
  for (const std::uint32_t end : std::span(block.ends).subspan(1)) known_.cycle_begin.push_back(corners + end);
  known_.corners.insert(known_.corners.end(), block.corners.begin(), block.corners.end());
}

void FaceLinks::sort_facets() {
  const auto row_less = [](const Facet& a, const Facet& b) { return a.plane.row() < b.plane.row(); };
  if (!std::is_sorted(known_.facets.begin(), known_.facets.end(), row_less)) {
    std::stable_sort(known_.facets.begin(), known_.facets.end(), row_less);
  }
  for (std::size_t i = 1; i < known_.facets.size(); ++i) {
    const std::uint32_t row = known_.facets[i].plane.row();
    if (known_.facets[i - 1].plane.row() != row) continue;
    if (known_.mixed_rows.empty() || known_.mixed_rows.back() != row) known_.mixed_rows.push_back(row);
  }
}

void FaceLinks::list_loose_corners() {
  if (2 * known_.corners.size() == made_.shalfedge_count() && made_.sloops.empty()) return;
  std::vector<bool> is_known(made_.shalfedge_count(), false);
  for (const SHalfedgeId corner : known_.corners) is_known[corner.index()] = true;
  for (const SHalfedgeId e : made_.shalfedge_ids()) {
    if (!is_known[e.index()] && !made_.shalfedge_plane[e].flipped()) known_.loose_corners.push_back(e);
  }
  for (const VertexId v : made_.vertex_ids()) {
    if (made_.vertices[v].sloops != made_.vertices[v.next()].sloops) known_.loose_isolated.push_back(v);
  }
}

}  // namespace

KnownLinks face_links(const Complex& made, const PlainVertices& plain, const Monitor& monitor) {
  return FaceLinks(made, plain, monitor).run();
}

}  // namespace nef
