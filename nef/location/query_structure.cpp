// SPDX-License-Identifier: Apache-2.0
//
// Facets, edges without facets, and vertices that bound no facet stand in one tree of boxes. A query asks the tree for
// the boxes that overlap the point (or, in ray_shooting.cpp, the ray) and decides each candidate by exact predicates. A
// facet with many corners gets a tree of its edges at the first query that needs it. A point in no item lies in the
// volume that a ray in direction -x comes through before it meets something.
#include "nef/location/query_structure.h"

#include <algorithm>
#include <mutex>

#include "nef/base/error.h"
#include "nef/complex/item_boxes.h"
#include "nef/location/facet_search.h"

namespace nef {
namespace {

// Facets with more corners than this get a tree over their edges.
constexpr std::size_t kLargeFacet = 32;

// Its integers are known from the start, so that threads may share it.
const Direction& minus_x() {
  static const Direction direction = Direction::exact(-1, 0, 0);
  return direction;
}

bool on_edge(const Complex& complex, HalfedgeId halfedge, const PointRef& point, const Monitor& monitor) {
  const SVertex& edge = complex.svertex(halfedge);
  if (side_of_plane(complex.planes, edge.p, point, monitor) != 0) return false;
  if (side_of_plane(complex.planes, edge.q, point, monitor) != 0) return false;
  // On the line; between the ends iff so in lexicographic order.
  const PointRef u{&complex.points, point_of(complex.source(halfedge))};
  const PointRef v{&complex.points, point_of(complex.target(halfedge))};
  for (int axis = 0; axis < 3; ++axis) {
    const int u_side = compare_coordinate(u, point, axis, monitor);
    const int v_side = compare_coordinate(v, point, axis, monitor);
    if (u_side != 0 || v_side != 0) return u_side * v_side < 0;
  }
  return false;
}

}  // namespace

struct QueryStructure::LargeFacet {
  std::once_flag once;
  BoxTree edges;
};

QueryStructure::QueryStructure(const Complex& complex) { collect(complex, nullptr); }

QueryStructure::QueryStructure(const Complex& complex, const BoxTree& places) { collect(complex, &places); }

void QueryStructure::collect(const Complex& complex, const BoxTree* places) {
  std::vector<Box> boxes;
  if (places == nullptr) boxes.reserve(complex.facet_count());
  const auto asked_for = [places](const Box& box) {
    bool found = places == nullptr;
    if (!found) places->for_each_overlap(box, [&found](std::uint32_t) { found = true; });
    return found;
  };
  for (const FacetId f : complex.facets.ids()) {
    const std::span<const SHalfedgeId> corners = complex.corners_of(f);
    Box box;
    for (const SHalfedgeId corner : corners) box.add(vertex_box(complex, complex.shalfedge_vertex(corner)));
    if (!asked_for(box)) continue;
    push_item(f.index(), kFacetItem, box, boxes);
    if (corners.size() > kLargeFacet) large_facets_.push_back(f);
  }
  for (const HalfedgeId h : complex.bare_edges()) {
    const Box box = edge_box(complex, h);
    if (asked_for(box)) push_item(h.index(), kEdgeItem, box, boxes);
  }
  for (const VertexId v : complex.vertex_ids()) {
    // Vertices that are no corner of a facet, or lie inside one.
    const VertexRecord& record = complex.vertices[v];
    const VertexRecord& end = complex.vertices[v.next()];
    if (record.shalfedges != end.shalfedges && record.sloops == end.sloops) continue;
    const Box box = vertex_box(complex, v);
    if (asked_for(box)) push_item(v.index(), kVertexItem, box, boxes);
  }
  tree_ = BoxTree(boxes);
  large_ = std::shared_ptr<LargeFacet[]>(new LargeFacet[large_facets_.size()]);
}

void QueryStructure::push_item(std::uint32_t index, Primitive kind, const Box& box, std::vector<Box>& boxes) {
  NEF_ASSERT(index < (1U << 30U));
  items_.push_back(4 * index + kind);
  boxes.push_back(mirrored(box));
}

const BoxTree* QueryStructure::edge_tree(const Complex& complex, FacetId facet) const {
  const auto found = std::lower_bound(large_facets_.begin(), large_facets_.end(), facet);
  if (found == large_facets_.end() || *found != facet) return nullptr;
  LargeFacet& large = large_[static_cast<std::size_t>(found - large_facets_.begin())];
  std::call_once(large.once, [&] { large.edges = facet_edge_tree(complex, complex.facets[facet]); });
  return &large.edges;
}

std::optional<VertexId> QueryStructure::free_vertex_at(const Complex& complex, const PointRef& point,
                                                       const Monitor& monitor) const {
  std::optional<VertexId> result;
  tree_.for_each_overlap(mirrored(point_box(point)), [&](std::uint32_t i) {
    const VertexId vertex{items_[i] / 4};
    if (items_[i] % 4 != kVertexItem || result) return;
    if (same_point({&complex.points, point_of(vertex)}, point, monitor)) result = vertex;
  });
  return result;
}

ItemRef QueryStructure::item_at(const Complex& complex, const PointRef& point, const Monitor& monitor) const {
  ItemRef result;
  tree_.for_each_overlap(mirrored(point_box(point)), [&](std::uint32_t i) {
    if (result.valid() && result.kind != ItemRef::Kind::kFacet) return;
    const std::uint32_t index = items_[i] / 4;
    switch (items_[i] % 4) {
      case kVertexItem:
        // A vertex inside a facet takes precedence over that facet.
        if (same_point({&complex.points, point_of(VertexId{index})}, point, monitor)) result = ItemRef(VertexId{index});
        return;
      case kEdgeItem: {
        const HalfedgeId edge{index};
        for (const VertexId end : {complex.source(edge), complex.target(edge)}) {
          if (same_point({&complex.points, point_of(end)}, point, monitor)) result = ItemRef(end);
        }
        if (on_edge(complex, edge, point, monitor)) result = ItemRef(edge);
        return;
      }
      default:
        break;
    }
    const FacetId f{index};
    const Facet& facet = complex.facets[f];
    if (result.valid() || side_of_plane(complex.planes, facet.plane, point, monitor) != 0) return;
    const ItemRef place = locate_in_facet(complex, f, point, edge_tree(complex, f), monitor);
    if (place.valid()) result = place;
  });
  if (result.kind == ItemRef::Kind::kEdge) result = ItemRef(complex.edge(result.halfedge()));
  return result;
}

std::optional<ComplexHit> QueryStructure::first_hit_minus_x(const Complex& complex, VertexId vertex,
                                                            const Monitor& monitor) const {
  return first_hit(complex, {{&complex.points, point_of(vertex)}, minus_x()}, {}, nullptr, monitor);
}

SFaceId QueryStructure::first_sface_minus_x(const Complex& complex, VertexId vertex, const Monitor& monitor) const {
  const std::optional<ComplexHit> hit = first_hit_minus_x(complex, vertex, monitor);
  if (!hit) return {};
  if (hit->kind == ComplexHit::Kind::kFacet) {
    // A corner is oriented like the positive halffacet; its twin looks to the other side.
    const SHalfedgeId corner = complex.corners_of(hit->facet())[0];
    return complex.shalfedge_sfaces(corner)[is_below(hit->halffacet) ? 1 : 0];
  }
  NEF_ASSERT(hit->sface.valid());
  return hit->sface;
}

VolumeId QueryStructure::volume_at(const Complex& complex, const PointRef& point, const Monitor& monitor) const {
  const std::optional<ComplexHit> hit = first_hit(complex, {point, minus_x()}, {}, nullptr, monitor);
  return hit ? volume_before(complex, *hit) : kOuterVolume;
}

VolumeId volume_before(const Complex& complex, const ComplexHit& hit) {
  if (hit.kind == ComplexHit::Kind::kFacet) return complex.halffacet_volume(hit.halffacet);
  NEF_ASSERT(hit.sface.valid());
  return complex.sface_volume(hit.sface);
}

std::size_t QueryStructure::bytes() const {
  return tree_.size() * (2 * sizeof(Box) + 2 * sizeof(std::uint32_t)) + items_.capacity() * sizeof(std::uint32_t);
}

}  // namespace nef
