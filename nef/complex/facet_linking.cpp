// SPDX-License-Identifier: Apache-2.0
//
// A cycle is an outer one iff it turns left at its lexicographically smallest vertex, at each of
// its corners there: the facet then lies within a half-plane. Most planes hold one outer cycle
// only, which owns all holes of the plane; otherwise a hole belongs to the innermost outer cycle
// around it, found by parity along a ray.
#include "nef/complex/facet_linking.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/complex/plane_ray.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

struct CycleRecord {
  std::uint32_t row = 0;    // of the plane
  std::uint32_t first = 0;  // range in the traced corners
  std::uint32_t count = 0;
  bool outer = false;
  std::uint32_t lowest = kNone;  // vertex, lexicographically
};

class FacetLinker {
 public:
  explicit FacetLinker(Complex& complex) : c_(complex) {}

  void run() {
    trace_cycles();
    collect_isolated();
    group_by_plane();
  }

 private:
  std::uint32_t next_corner(std::uint32_t corner) const {
    const std::uint32_t there = c_.twin[c_.corner_halfedge(corner)];
    const std::uint32_t vertex = c_.svertex_owner[there];
    const SphereMapView map = c_.sphere_map(vertex);
    const PlaneId wanted = c_.shalfedges[corner].plane.opposite();
    const std::uint32_t first = map.svertices[there - c_.vertices[vertex].svertices].out;
    std::uint32_t e = first;
    while (map.shalfedges[e].plane != wanted) {
      e = map.next_around(e);
      NEF_ASSERT(e != first);
    }
    return c_.vertices[vertex].shalfedges + (e ^ 1U);
  }

  void trace_cycles() {
    std::vector<bool> done(c_.shalfedges.size(), false);
    traced_.reserve(c_.shalfedges.size() / 2);
    for (std::uint32_t e = 0; e < c_.shalfedges.size(); ++e) {
      if (c_.shalfedges[e].plane.flipped() || done[e]) continue;
      CycleRecord cycle;
      cycle.row = c_.shalfedges[e].plane.row();
      cycle.first = static_cast<std::uint32_t>(traced_.size());
      for (std::uint32_t corner = e; !done[corner]; corner = next_corner(corner)) {
        done[corner] = true;
        traced_.push_back(corner);
      }
      cycle.count = static_cast<std::uint32_t>(traced_.size()) - cycle.first;
      cycles_.push_back(cycle);
    }
  }

  void collect_isolated() {
    for (std::uint32_t v = 0; v < c_.vertex_count(); ++v) {
      const SphereMapView map = c_.sphere_map(v);
      if (!map.sloops.empty()) isolated_.emplace_back(map.sloops[0].plane.row(), v);
    }
  }

  // Counting sort by plane row, so that the order of facets depends on nothing but the input.
  void group_by_plane() {
    std::vector<std::uint32_t> start(c_.planes.size() + 1, 0);
    for (const CycleRecord& cycle : cycles_) ++start[cycle.row + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    std::vector<std::uint32_t> order(cycles_.size());
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    for (std::uint32_t i = 0; i < cycles_.size(); ++i) order[at[cycles_[i].row]++] = i;
    std::sort(isolated_.begin(), isolated_.end());
    auto isolated = isolated_.begin();
    c_.facets.clear();
    c_.facets.reserve(cycles_.size());
    c_.cycle_begin.assign(1, 0);
    c_.cycle_begin.reserve(cycles_.size() + 1);
    c_.corners.clear();
    c_.corners.reserve(traced_.size());
    c_.isolated_vertices.clear();
    c_.shalfedge_facet.assign(c_.shalfedges.size(), kNone);
    c_.sloop_facet.assign(c_.sloops.size(), kNone);
    for (std::uint32_t row = 0; row + 1 < start.size(); ++row) {
      const auto first = isolated;
      while (isolated != isolated_.end() && isolated->first == row) ++isolated;
      const std::span<const std::uint32_t> cycles(order.data() + start[row], start[row + 1] - start[row]);
      const std::span<const std::pair<std::uint32_t, std::uint32_t>> points(first, isolated);
      if (!cycles.empty()) link_plane(row, cycles, points);
      NEF_ASSERT(!cycles.empty() || points.empty());
    }
  }

  void link_plane(std::uint32_t row, std::span<const std::uint32_t> cycles,
                  std::span<const std::pair<std::uint32_t, std::uint32_t>> points) {
    if (cycles.size() == 1 && points.empty()) {
      emit(row, cycles, {});
      return;
    }
    const PlaneAxes axes(c_.planes, PlaneId{row << 1U});
    std::vector<std::uint32_t> outers;
    std::vector<std::uint32_t> holes;
    for (const std::uint32_t i : cycles) {
      classify(cycles_[i], axes);
      (cycles_[i].outer ? outers : holes).push_back(i);
    }
    NEF_ASSERT(!outers.empty());
    std::vector<std::vector<std::uint32_t>> members(outers.size());
    std::vector<std::vector<std::uint32_t>> inside(outers.size());
    for (std::size_t k = 0; k < outers.size(); ++k) members[k].push_back(outers[k]);
    if (outers.size() == 1) {
      for (const std::uint32_t hole : holes) members[0].push_back(hole);
      for (const auto& point : points) inside[0].push_back(point.second);
    } else if (!holes.empty() || !points.empty()) {
      nest(row, axes, outers, holes, points, members, inside);
    }
    for (std::size_t k = 0; k < outers.size(); ++k) emit(row, members[k], inside[k]);
  }

  void classify(CycleRecord& cycle, const PlaneAxes& axes) const {
    const std::span<const std::uint32_t> corners(traced_.data() + cycle.first, cycle.count);
    for (const std::uint32_t corner : corners) {
      const std::uint32_t v = c_.shalfedge_owner[corner];
      if (v == cycle.lowest) continue;
      if (cycle.lowest == kNone || axes.compare(c_.points, PointId{v}, PointId{cycle.lowest}) < 0) cycle.lowest = v;
    }
    cycle.outer = true;
    for (const std::uint32_t corner : corners) {
      if (c_.shalfedge_owner[corner] != cycle.lowest) continue;
      const std::uint32_t ahead = c_.corner_halfedge(corner);
      const std::uint32_t back = c_.corner_back_halfedge(corner);
      if (ahead == back ||
          orientation_on_circle(c_.planes, c_.shalfedges[corner].plane, direction_of(c_.planes, c_.svertices[ahead]),
                                direction_of(c_.planes, c_.svertices[back])) <= 0) {
        cycle.outer = false;
        return;
      }
    }
  }

  void nest(std::uint32_t row, const PlaneAxes& axes, std::span<const std::uint32_t> outers,
            std::span<const std::uint32_t> holes, std::span<const std::pair<std::uint32_t, std::uint32_t>> points,
            std::vector<std::vector<std::uint32_t>>& members, std::vector<std::vector<std::uint32_t>>& inside) const {
    std::vector<PlaneRayEdge> edges;
    for (std::uint32_t k = 0; k < outers.size(); ++k) {
      const CycleRecord& cycle = cycles_[outers[k]];
      for (std::uint32_t i = 0; i < cycle.count; ++i) {
        edges.push_back({c_.corner_halfedge(traced_[cycle.first + i]), k});
      }
    }
    const PlaneRay ray(c_, PlaneId{row << 1U}, axes, std::move(edges));
    std::vector<int> depth(outers.size(), -1);
    const auto owner = [&](std::uint32_t vertex) {
      const std::vector<std::uint32_t> around = ray.owners_with_odd_parity(vertex);
      NEF_ASSERT(!around.empty());
      std::uint32_t best = around.front();
      for (const std::uint32_t k : around) {
        if (depth[k] < 0) {
          depth[k] = static_cast<int>(ray.owners_with_odd_parity(cycles_[outers[k]].lowest).size());
        }
        if (depth[k] > depth[best]) best = k;
      }
      return best;
    };
    for (const std::uint32_t hole : holes) members[owner(cycles_[hole].lowest)].push_back(hole);
    for (const auto& point : points) inside[owner(point.second)].push_back(point.second);
  }

  void emit(std::uint32_t row, std::span<const std::uint32_t> cycles, std::span<const std::uint32_t> inside) {
    Facet facet;
    facet.plane = PlaneId{row << 1U};
    facet.first_cycle = static_cast<std::uint32_t>(c_.cycle_begin.size() - 1);
    facet.cycle_count = static_cast<std::uint32_t>(cycles.size());
    facet.first_isolated = static_cast<std::uint32_t>(c_.isolated_vertices.size());
    facet.isolated_count = static_cast<std::uint32_t>(inside.size());
    const auto halffacet = static_cast<std::uint32_t>(2 * c_.facets.size());
    for (const std::uint32_t i : cycles) {
      const CycleRecord& cycle = cycles_[i];
      for (std::uint32_t k = 0; k < cycle.count; ++k) {
        const std::uint32_t corner = traced_[cycle.first + k];
        c_.corners.push_back(corner);
        c_.shalfedge_facet[corner] = halffacet;
        c_.shalfedge_facet[corner ^ 1U] = halffacet + 1;
      }
      c_.cycle_begin.push_back(static_cast<std::uint32_t>(c_.corners.size()));
    }
    facet.mark = c_.shalfedges[traced_[cycles_[cycles[0]].first]].mark;
    for (const std::uint32_t v : inside) {
      c_.isolated_vertices.push_back(v);
      const std::uint32_t first = c_.vertices[v].sloops;
      for (std::uint32_t l = first; l < first + 2; ++l) {
        c_.sloop_facet[l] = halffacet + (c_.sloops[l].plane.flipped() ? 1U : 0U);
      }
    }
    c_.facets.push_back(facet);
  }

  Complex& c_;
  std::vector<std::uint32_t> traced_;
  std::vector<CycleRecord> cycles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> isolated_;  // (plane row, vertex)
};

}  // namespace

void link_facets(Complex& complex) { FacetLinker(complex).run(); }

}  // namespace nef
