// SPDX-License-Identifier: Apache-2.0
//
// Facets of one operand are put into a tree of boxes; vertices and edges of the other ask it. Facets around vertices of
// high degree are told apart by their directions from there (WideFans).
// "Bare" edges and vertices, which bound no facet, are invisible to facets and ask each other.
#include "nef/boolean/intersections.h"

#include <algorithm>
#include <unordered_set>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/boolean/facet_locator.h"
#include "nef/boolean/result/wide_fans.h"
#include "nef/boolean/triangle_filter.h"
#include "nef/geometry/search/occupancy_grid.h"

namespace nef {
namespace {

class IntersectionFinder {
 public:
  IntersectionFinder(const std::array<Operand, 2>& operands, CommonTables& tables, const Monitor& monitor)
      : operands_(operands),
        tables_(tables),
        monitor_(monitor),
        locators_{FacetLocator{operands[0], operands[1], tables}, FacetLocator{operands[1], operands[0], tables}} {
    for (std::size_t x = 0; x < 2; ++x) result_.vertex_item[x].resize(operands[x].complex().vertex_count());
  }

  Intersections run() {
    if (operands_[0].bounds().overlaps(operands_[1].bounds())) {
      collect();
      for (std::size_t x = 0; x < 2; ++x) {
        vertices_against_facets(x);
        vertices_against_bare(x);
      }
      for (std::size_t x = 0; x < 2; ++x) edges_against_facets(x);
      bare_edges();
      for (std::size_t x = 0; x < 2; ++x) note_vertices_on_edges(x);
    }
    for (auto& contacts : result_.contacts) std::sort(contacts.begin(), contacts.end());
    return std::move(result_);
  }

 private:
  // What of an operand can meet the other one.
  struct Near {
    std::vector<FacetId> facets;
    BoxTree facet_tree;
    WideFans wide_fans;  // of the facets
    std::vector<VertexId> vertices;
    std::vector<HalfedgeId> edges;
    std::vector<HalfedgeId> bare_edges;
    BoxTree bare_edge_tree;
    std::vector<VertexId> bare_vertices;
    BoxTree bare_vertex_tree;
  };

  // Items of an operand that reach the other's bounds, and where.
  template <typename I>
  struct Items {
    std::vector<I> ids;
    std::vector<CellRange> cells;
  };
  struct Candidates {
    IndexedVector<VertexId, CellRange> vertices;  // all, whether they reach or not
    Items<FacetId> facets;
    Items<HalfedgeId> bare_edges;
    Items<VertexId> bare_vertices;
  };

  [[nodiscard]] CellRange edge_cells(std::size_t x, const Candidates& found, HalfedgeId halfedge) const {
    CellRange cells = found.vertices[operands_[x].source(halfedge)];
    cells.add(found.vertices[operands_[x].target(halfedge)]);
    return cells;
  }

  Candidates candidates(std::size_t x, const OccupancyGrid& grid) const {
    const Operand& operand = operands_[x];
    const Complex& c = operand.complex();
    Candidates found;
    const auto take = [&grid](auto& items, auto id, const CellRange& cells) {
      if (!grid.reaches(cells)) return;
      items.ids.push_back(id);
      items.cells.push_back(cells);
    };
    found.vertices.reserve(c.vertex_count());
    for (const VertexId v : c.vertex_ids()) {
      found.vertices.push_back(grid.range(operand.vertex_box(v)));
      const VertexRecord& first = c.vertices[v];
      const VertexRecord& last = c.vertices[v.next()];
      if (first.shalfedges != last.shalfedges || first.sloops != last.sloops) continue;
      take(found.bare_vertices, v, found.vertices[v]);
    }
    for (const FacetId f : c.facets.ids()) {
      CellRange cells;
      for (const SHalfedgeId corner : c.corners_of(c.facets[f].first_cycle)) {
        cells.add(found.vertices[c.shalfedge_vertex(corner)]);
      }
      take(found.facets, f, cells);
    }
    for (const HalfedgeId e : c.bare_edges()) take(found.bare_edges, e, edge_cells(x, found, e));
    return found;
  }

  // Everything of an operand lies on the borders of its facets or is bare, so that a grid of these tells what of the
  // other operand can be left out. Most surfaces come close to each other in few places.
  void collect() {
    Box region;
    for (std::size_t i = 0; i < 3; ++i) {
      region.low[i] = std::max(operands_[0].bounds().low[i], operands_[1].bounds().low[i]);
      region.high[i] = std::min(operands_[0].bounds().high[i], operands_[1].bounds().high[i]);
    }
    const std::size_t count = operands_[0].complex().facets.size() + operands_[1].complex().facets.size();
    std::array<OccupancyGrid, 2> grids{OccupancyGrid(region, count), OccupancyGrid(region, count)};
    std::array<Candidates, 2> found;
    parallel_for(2, monitor_, [&](std::size_t x, const Monitor&) {
      found[x] = candidates(x, grids[x]);
      for (const auto* cells : {&found[x].facets.cells, &found[x].bare_edges.cells, &found[x].bare_vertices.cells}) {
        for (const CellRange& range : *cells) grids[x].mark(range);
      }
    });
    parallel_for(2, monitor_, [&](std::size_t x, const Monitor&) { collect(x, found[x], grids[1 - x]); });
  }

  // The items that come near the other operand, with a tree of their boxes.
  template <typename I, typename BoxOf>
  static std::vector<I> keep(const Items<I>& items, const OccupancyGrid& other, BoxOf&& box_of, BoxTree& tree) {
    std::vector<I> kept;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < items.ids.size(); ++i) {
      if (!other.touches(items.cells[i])) continue;
      kept.push_back(items.ids[i]);
      boxes.push_back(box_of(items.ids[i]));
    }
    tree = BoxTree(boxes);
    return kept;
  }

  void collect(std::size_t x, const Candidates& found, const OccupancyGrid& other) {
    const Operand& operand = operands_[x];
    const Complex& c = operand.complex();
    Near& near = near_[x];
    const auto facet_box = [&](FacetId f) { return operand.facet_box(f); };
    const auto edge_box = [&](HalfedgeId e) { return operand.edge_box(e); };
    const auto vertex_box = [&](VertexId v) { return operand.vertex_box(v); };
    near.facets = keep(found.facets, other, facet_box, near.facet_tree);
    near.wide_fans = WideFans(operand, near.facets);
    locators_[x].expect(near.facets);
    near.bare_edges = keep(found.bare_edges, other, edge_box, near.bare_edge_tree);
    near.bare_vertices = keep(found.bare_vertices, other, vertex_box, near.bare_vertex_tree);
    // The ends of an edge that is near need not be.
    for (const VertexId v : c.vertex_ids()) {
      const CellRange& cells = found.vertices[v];
      if (other.reaches(cells) && other.touches(cells)) near.vertices.push_back(v);
    }
    for (const HalfedgeId e : c.halfedge_ids()) {
      if (e > c.twin[e]) continue;
      const CellRange cells = edge_cells(x, found, e);
      if (other.reaches(cells) && other.touches(cells)) near.edges.push_back(e);
    }
  }

  int side(PlaneId plane, PointId point, const Monitor& monitor) const {
    return side_of_plane(tables_.planes, plane, tables_.points, point, monitor);
  }

  // A vertex of operand x has been found on an item of the other one.
  void place_vertex(std::size_t x, VertexId vertex, const ItemRef& item) {
    result_.vertex_item[x][vertex] = item;
    if (item.kind == ItemRef::Kind::kVertex) result_.vertex_item[1 - x][item.vertex()] = ItemRef(vertex);
  }

  // A vertex or an edge of one operand and a facet of the other that may meet it.
  template <typename I>
  struct Pair {
    I own;
    FacetId facet;
  };

  // Finds pairs for `count` items of one operand on several threads, many items at a time, and uses them on this one,
  // in the order of the items and of their facets, which no tree decides: finding only looks, and rules out nearly all
  // pairs; using may add points and results.
  template <typename I, typename Find, typename Use>
  void find_and_use(std::size_t count, const char* phase, const Find& find, const Use& use) {
    constexpr std::size_t kTogether = 1024;
    constexpr std::size_t kAtOnce = 16;
    std::array<std::vector<Pair<I>>, kAtOnce> found;
    for (std::size_t begin = 0; begin < count; begin += kAtOnce * kTogether) {
      monitor_.check_interruption();
      monitor_.tell_progress(phase, begin, count);
      const std::size_t end = std::min(count, begin + kAtOnce * kTogether);
      parallel_for_ranges(end - begin, kTogether, monitor_,
                          [&](std::size_t first, std::size_t last, const Monitor& own) {
                            std::vector<Pair<I>>& pairs = found[first / kTogether];
                            pairs.clear();
                            for (std::size_t k = begin + first; k < begin + last; ++k) {
                              const auto of_before = static_cast<std::ptrdiff_t>(pairs.size());
                              find(k, pairs, own);
                              std::sort(pairs.begin() + of_before, pairs.end(),
                                        [](const Pair<I>& a, const Pair<I>& b) { return a.facet < b.facet; });
                            }
                          });
      for (std::size_t part = 0; part * kTogether < end - begin; ++part) {
        for (const Pair<I>& pair : found[part]) use(pair);
      }
    }
  }

  void vertices_against_facets(std::size_t x) {
    const Operand& other = operands_[1 - x];
    const std::vector<VertexId>& vertices = near_[x].vertices;
    const auto placed = [&](VertexId v) { return result_.vertex_item[x][v].valid(); };
    const auto find = [&](std::size_t k, std::vector<Pair<VertexId>>& pairs, const Monitor& monitor) {
      const VertexId v = vertices[k];
      if (placed(v)) return;
      for_each_facet_near(x, v, [&](FacetId facet) {
        if (side(other.facet_plane(facet), operands_[x].point(v), monitor) == 0) pairs.push_back({v, facet});
      });
    };
    find_and_use<VertexId>(vertices.size(), "vertices in facets", find, [&](const Pair<VertexId>& pair) {
      if (placed(pair.own)) return;
      const ItemRef item = locators_[1 - x].locate(pair.facet, operands_[x].point(pair.own), monitor_);
      if (item.valid()) place_vertex(x, pair.own, item);
    });
  }

  void vertices_against_bare(std::size_t x) {
    const Operand& other = operands_[1 - x];
    const Near& targets = near_[1 - x];
    if (targets.bare_vertices.empty() && targets.bare_edges.empty()) return;
    for (const VertexId v : near_[x].vertices) {
      const PointId p = operands_[x].point(v);
      const Box box = operands_[x].vertex_box(v);
      targets.bare_vertex_tree.for_each_overlap(box, [&](std::uint32_t i) {
        if (result_.vertex_item[x][v].valid()) return;
        const VertexId w = targets.bare_vertices[i];
        if (compare_lexicographic(tables_.points, p, other.point(w), monitor_) == 0) place_vertex(x, v, ItemRef(w));
      });
      targets.bare_edge_tree.for_each_overlap(box, [&](std::uint32_t i) {
        if (result_.vertex_item[x][v].valid()) return;
        const HalfedgeId e = targets.bare_edges[i];
        if (side(other.svertex(e).p, p, monitor_) != 0 || side(other.svertex(e).q, p, monitor_) != 0) return;
        const int from = compare_lexicographic(tables_.points, p, other.point(other.source(e)), monitor_);
        const int to = compare_lexicographic(tables_.points, p, other.point(other.target(e)), monitor_);
        if (from * to < 0) place_vertex(x, v, ItemRef(e));
        if (from == 0) place_vertex(x, v, ItemRef(other.source(e)));
        if (to == 0) place_vertex(x, v, ItemRef(other.target(e)));
      });
    }
  }

  void edges_against_facets(std::size_t x) {
    const Operand& own = operands_[x];
    const Operand& other = operands_[1 - x];
    const std::vector<HalfedgeId>& edges = near_[x].edges;
    const auto find = [&](std::size_t k, std::vector<Pair<HalfedgeId>>& pairs, const Monitor& monitor) {
      const HalfedgeId e = edges[k];
      const PointId a = own.point(own.source(e));
      const PointId b = own.point(own.target(e));
      for_each_facet_near(x, e, [&](FacetId facet) {
        const PlaneId plane = other.facet_plane(facet);
        const int side_a = side(plane, a, monitor);
        const int side_b = side(plane, b, monitor);
        const bool may_meet =
            side_a * side_b < 0 ? may_pierce(1 - x, a, b, facet, monitor) : side_a == 0 && side_b == 0;
        if (may_meet) pairs.push_back({e, facet});
      });
    };
    find_and_use<HalfedgeId>(edges.size(), "edges through facets", find, [&](const Pair<HalfedgeId>& pair) {
      const HalfedgeId e = pair.own;
      const PlaneId plane = other.facet_plane(pair.facet);
      if (side(plane, own.point(own.source(e)), monitor_) != 0) {
        pierce(x, e, pair.facet);
        return;
      }
      locators_[1 - x].for_each_edge(pair.facet, own.edge_box(e),
                                     [&](HalfedgeId f) { cross_in_plane(x, e, other.edge(f), plane); });
    });
  }

  // The facets of the other operand, where it has vertices of high degree, that may meet the segment between two
  // vertices of operand x, or one vertex.
  template <typename Visit>
  void visit_wide(std::size_t x, std::span<const VertexId> vertices, const Box& box, const Visit& visit) const {
    std::vector<Double3> ends;
    std::vector<VertexId> end_at;
    for (const VertexId v : vertices) {
      ends.push_back(tables_.points.approximate(operands_[x].point(v)));
      const ItemRef& item = result_.vertex_item[x][v];
      end_at.push_back(item.kind == ItemRef::Kind::kVertex ? item.vertex() : VertexId());
    }
    std::vector<std::uint32_t> places;
    near_[1 - x].wide_fans.find(ends, end_at, box, places);
    for (const std::uint32_t place : places) visit(near_[1 - x].facets[place]);
  }

  template <typename Visit>
  void for_each_facet_near(std::size_t x, VertexId v, const Visit& visit) const {
    const Near& near = near_[1 - x];
    if (near.wide_fans.empty()) {
      near.facet_tree.for_each_overlap(operands_[x].vertex_box(v), [&](std::uint32_t i) { visit(near.facets[i]); });
    } else {
      visit_wide(x, std::array{v}, operands_[x].vertex_box(v), visit);
    }
  }

  // The facets of the other operand that may have more than an end in common with edge e of operand x. Where a vertex
  // of the other operand lies is known by now.
  template <typename Visit>
  void for_each_facet_near(std::size_t x, HalfedgeId e, const Visit& visit) const {
    const Operand& own = operands_[x];
    const Near& near = near_[1 - x];
    if (near.wide_fans.empty()) {
      near.facet_tree.for_each_overlap(own.edge_box(e), [&](std::uint32_t i) { visit(near.facets[i]); });
      return;
    }
    const std::array vertices{own.source(e), own.target(e)};
    visit_wide(x, vertices, own.edge_box(e), visit);
  }

  // False only if the segment from a to b, which passes through the plane of a facet of operand x, misses the facet.
  [[nodiscard]] bool may_pierce(std::size_t x, PointId a, PointId b, FacetId facet, const Monitor& monitor) const {
    const Operand& operand = operands_[x];
    const std::span<const SHalfedgeId> corners = operand.complex().corners_of(facet);
    if (corners.size() != 3) return true;
    const auto point = [&](std::size_t i) { return operand.point(operand.complex().shalfedge_vertex(corners[i])); };
    if (!surely_misses_triangle(tables_.points, a, b, {point(0), point(1), point(2)})) return true;
    monitor.count_filter();
    return false;
  }

  // Edge e of operand x passes through the plane of a facet of the other.
  void pierce(std::size_t x, HalfedgeId e, FacetId facet) {
    const SVertex line = operands_[x].svertex(e);
    const std::optional<PointId> point =
        tables_.points.push_intersection(tables_.planes, line.p, line.q, operands_[1 - x].facet_plane(facet));
    NEF_ASSERT(point.has_value());
    const ItemRef item = locators_[1 - x].locate(facet, *point, monitor_);
    const bool used = item.kind == ItemRef::Kind::kFacet || item.kind == ItemRef::Kind::kEdge;
    if (!used || !add_crossing(x, e, item, *point)) tables_.points.pop();
    if (item.kind == ItemRef::Kind::kVertex) place_vertex(1 - x, item.vertex(), ItemRef(e));
  }

  // Both edges lie in `plane`; they cross iff each has the ends of the other strictly on both
  // sides.
  void cross_in_plane(std::size_t x, HalfedgeId e, HalfedgeId f, PlaneId plane) {
    const Operand& own = operands_[x];
    const Operand& other = operands_[1 - x];
    const PlaneId through_f = other.edge_side(tables_.planes, plane, f, monitor_).other;
    if (!parts(through_f, own.point(own.source(e)), own.point(own.target(e)))) return;
    const PlaneId through_e = own.edge_side(tables_.planes, plane, e, monitor_).other;
    if (!parts(through_e, other.point(other.source(f)), other.point(other.target(f)))) return;
    const std::optional<PointId> point = tables_.points.push_intersection(tables_.planes, plane, through_e, through_f);
    NEF_ASSERT(point.has_value());
    if (!add_crossing(x, e, ItemRef(f), *point)) tables_.points.pop();
  }

  // True if the points lie strictly on both sides of the plane.
  [[nodiscard]] bool parts(PlaneId plane, PointId a, PointId b) const {
    return side(plane, a, monitor_) * side(plane, b, monitor_) < 0;
  }

  bool add_crossing(std::size_t x, HalfedgeId e, const ItemRef& item, PointId point) {
    Crossing crossing;
    crossing.point = point;
    crossing.item[x] = ItemRef(e);
    crossing.item[1 - x] = item;
    if (item.kind == ItemRef::Kind::kEdge) {
      // Found once for every facet around either edge.
      const std::uint64_t key = static_cast<std::uint64_t>(crossing.item[0].index) << 32U | crossing.item[1].index;
      if (!edge_pairs_.insert(key).second) return false;
      result_.contacts[1 - x].push_back({item.halfedge(), point, crossing.item[x]});
    }
    result_.contacts[x].push_back({e, point, item});
    result_.crossings.push_back(crossing);
    return true;
  }

  void bare_edges() {
    const Operand& a = operands_[0];
    const Operand& b = operands_[1];
    std::vector<HalfedgeId> others;
    for (const HalfedgeId e : near_[0].bare_edges) {
      const SVertex line = a.svertex(e);
      others.clear();
      near_[1].bare_edge_tree.for_each_overlap(a.edge_box(e),
                                               [&](std::uint32_t i) { others.push_back(near_[1].bare_edges[i]); });
      std::sort(others.begin(), others.end());
      for (const HalfedgeId f : others) {
        const SVertex other = b.svertex(f);
        // The lines meet in a point iff it lies on all four planes; three of them that are
        // independent give it.
        for (const PlaneId plane : {other.p, other.q}) {
          const std::optional<PointId> point = tables_.points.push_intersection(tables_.planes, line.p, line.q, plane);
          if (!point) continue;
          const bool on_both = side(other.p, *point, monitor_) == 0 && side(other.q, *point, monitor_) == 0 &&
                               inside(a, e, *point) && inside(b, f, *point);
          if (!on_both || !add_crossing(0, e, ItemRef(f), *point)) tables_.points.pop();
          break;
        }
      }
    }
  }

  bool inside(const Operand& operand, HalfedgeId e, PointId point) const {
    return compare_lexicographic(tables_.points, point, operand.point(operand.source(e)), monitor_) *
               compare_lexicographic(tables_.points, point, operand.point(operand.target(e)), monitor_) <
           0;
  }

  void note_vertices_on_edges(std::size_t x) {
    for (const VertexId v : near_[x].vertices) {
      const ItemRef& item = result_.vertex_item[x][v];
      if (item.kind != ItemRef::Kind::kEdge) continue;
      result_.contacts[1 - x].push_back({item.halfedge(), operands_[x].point(v), ItemRef(v)});
    }
  }

  const std::array<Operand, 2>& operands_;
  CommonTables& tables_;
  Monitor monitor_;
  std::array<FacetLocator, 2> locators_;
  std::array<Near, 2> near_;
  std::unordered_set<std::uint64_t> edge_pairs_;
  Intersections result_;
};

}  // namespace

Intersections intersect_boundaries(const std::array<Operand, 2>& operands, CommonTables& tables,
                                   const Monitor& monitor) {
  return IntersectionFinder(operands, tables, monitor).run();
}

}  // namespace nef
