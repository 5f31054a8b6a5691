// SPDX-License-Identifier: Apache-2.0
//
// A cycle is an outer one iff it turns left at its lexicographically smallest vertex, at each of
// its corners there: the facet then lies within a half-plane. Most planes hold one outer cycle
// only, which owns all holes of the plane. Otherwise a hole, or a vertex inside a facet, sees its
// facet straight below its lowest vertex, and the first edge on the way down bounds that facet, too:
// it belongs where the cycle of that edge belongs, which begins further down in lexicographic order.
#include "nef/synthesis/facet_linking.h"

#include <algorithm>

#include "nef/base/defect.h"
#include "nef/base/parallel.h"
#include "nef/complex/facet_plane.h"
#include "nef/complex/plane_sweep.h"
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
  /// `known` may be null.
  FacetLinker(Complex& complex, const KnownLinks* known, unsigned threads)
      : c_(complex), known_(known), threads_(threads) {}

  void run() {
    trace_cycles();
    collect_isolated();
    group_by_plane();
    name_facets_of_corners();
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
      detail::require(e != first, "a facet goes on along its edges", {{"shalfedge", corner}});
    }
    return c_.vertices[vertex].shalfedges + (e ^ 1U);
  }

  void trace_cycles() {
    std::vector<bool> done(c_.shalfedges.size(), false);
    const auto trace_from = [&](std::uint32_t e) {
      if (c_.shalfedges[e].plane.flipped() || done[e]) return;
      CycleRecord cycle;
      cycle.row = c_.shalfedges[e].plane.row();
      cycle.first = static_cast<std::uint32_t>(traced_.size());
      std::uint32_t corner = e;
      for (; !done[corner]; corner = next_corner(corner)) {
        done[corner] = true;
        traced_.push_back(corner);
      }
      detail::require(corner == e, "cycles of facets are disjoint", {{"shalfedge", e}, {"shalfedge", corner}});
      cycle.count = static_cast<std::uint32_t>(traced_.size()) - cycle.first;
      cycles_.push_back(cycle);
    };
    if (known_ == nullptr) {
      traced_.reserve(c_.shalfedges.size() / 2);
      for (std::uint32_t e = 0; e < c_.shalfedges.size(); ++e) trace_from(e);
    } else {
      traced_.reserve(known_->loose_corners.size());
      for (const std::uint32_t e : known_->loose_corners) trace_from(e);
    }
  }

  void collect_isolated() {
    const auto collect = [this](std::uint32_t v) {
      if (c_.vertices[v].sloops == c_.vertices[v + 1].sloops) return;
      isolated_.emplace_back(c_.sloops[c_.vertices[v].sloops].plane.row(), v);
    };
    if (known_ == nullptr) {
      for (std::uint32_t v = 0; v < c_.vertex_count(); ++v) collect(v);
    } else {
      for (const std::uint32_t v : known_->loose_isolated) collect(v);
    }
  }

  // Counting sort by plane row, so that the order of facets depends on nothing but the input. Known facets between two
  // planes that hold anything else are taken over together.
  void group_by_plane() {
    std::vector<std::uint32_t> start(c_.planes.size() + 1, 0);
    for (const CycleRecord& cycle : cycles_) ++start[cycle.row + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    std::vector<std::uint32_t> order(cycles_.size());
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    for (std::uint32_t i = 0; i < cycles_.size(); ++i) order[at[cycles_[i].row]++] = i;
    std::sort(isolated_.begin(), isolated_.end());
    make_room();
    const std::span<const Facet> known = known_ == nullptr ? std::span<const Facet>() : known_->facets;
    const std::span<const std::uint32_t> mixed =
        known_ == nullptr ? std::span<const std::uint32_t>() : known_->mixed_rows;
    auto isolated = isolated_.begin();
    auto next_mixed = mixed.begin();
    auto kept = known.begin();
    for (std::uint32_t row = 0; row + 1 < start.size(); ++row) {
      const bool is_mixed = next_mixed != mixed.end() && *next_mixed == row;
      const bool has_points = isolated != isolated_.end() && isolated->first == row;
      if (start[row] == start[row + 1] && !is_mixed && !has_points) continue;
      if (is_mixed) ++next_mixed;
      const auto first = isolated;
      while (isolated != isolated_.end() && isolated->first == row) ++isolated;
      const std::span<const std::uint32_t> cycles(order.data() + start[row], start[row + 1] - start[row]);
      const std::span<const std::pair<std::uint32_t, std::uint32_t>> points(first, isolated);
      const auto before = kept;
      while (kept != known.end() && kept->plane.row() < row) ++kept;
      emit_known({before, kept});
      const auto first_kept = kept;
      while (kept != known.end() && kept->plane.row() == row) ++kept;
      if (first_kept != kept) {
        link_plane_with_known(row, cycles, points, {first_kept, kept});
        continue;
      }
      if (!cycles.empty()) link_plane(row, cycles, points);
      detail::require(!cycles.empty() || points.empty(), "a vertex inside a facet has a facet around it",
                      {{"vertex", points.empty() ? 0 : points[0].second}});
    }
    emit_known({kept, known.end()});
  }

  void make_room() {
    c_.facets.clear();
    c_.cycle_begin.assign(1, 0);
    c_.corners.clear();
    c_.isolated_vertices.clear();
    const bool knows = known_ != nullptr;
    c_.facets.reserve(cycles_.size() + (knows ? known_->facets.size() : 0));
    c_.cycle_begin.reserve(cycles_.size() + 1 + (knows ? known_->cycle_begin.size() : 0));
    c_.corners.reserve(traced_.size() + (knows ? known_->corners.size() : 0));
    c_.sloop_facet.assign(c_.sloops.size(), HalffacetId());
  }

  // Known facets in a plane with others are linked anew, with these, which may be holes of theirs.
  void link_plane_with_known(std::uint32_t row, std::span<const std::uint32_t> cycles,
                             std::span<const std::pair<std::uint32_t, std::uint32_t>> points,
                             std::span<const Facet> facets) {
    std::vector<std::uint32_t> all(cycles.begin(), cycles.end());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> inside(points.begin(), points.end());
    for (const Facet& facet : facets) {
      for (const CycleId i : facet.cycles()) {
        CycleRecord cycle;
        cycle.row = row;
        cycle.first = static_cast<std::uint32_t>(traced_.size());
        cycle.count = known_->cycle_begin[i.next()] - known_->cycle_begin[i];
        const auto corners = known_->corners.begin() + known_->cycle_begin[i];
        traced_.insert(traced_.end(), corners, corners + cycle.count);
        all.push_back(static_cast<std::uint32_t>(cycles_.size()));
        cycles_.push_back(cycle);
      }
      for (std::uint32_t i = facet.first_isolated; i < facet.first_isolated + facet.isolated_count; ++i) {
        inside.emplace_back(row, known_->isolated_vertices[i]);
      }
    }
    std::sort(all.begin(), all.end(), [this](std::uint32_t a, std::uint32_t b) {
      return traced_[cycles_[a].first] < traced_[cycles_[b].first];
    });
    std::sort(inside.begin(), inside.end());
    link_plane(row, all, inside);
  }

  // Facets in planes of their own, as they are known. Those that follow each other with their cycles are one block.
  void emit_known(std::span<const Facet> facets) {
    while (!facets.empty()) {
      std::size_t count = 1;
      while (count < facets.size() && facets[count].first_cycle == facets[count - 1].cycles().end_id() &&
             facets[count].first_isolated == facets[count - 1].first_isolated + facets[count - 1].isolated_count) {
        ++count;
      }
      emit_known_block(facets.first(count));
      facets = facets.subspan(count);
    }
  }

  void emit_known_block(std::span<const Facet> facets) {
    const CycleId first = facets.front().first_cycle;
    const CycleId end = facets.back().cycles().end_id();
    const std::uint32_t first_inside = facets.front().first_isolated;
    const std::uint32_t end_inside = facets.back().first_isolated + facets.back().isolated_count;
    const auto base = static_cast<std::uint32_t>(c_.corners.size()) - known_->cycle_begin[first];  // modulo 2^32
    const auto cycles = static_cast<std::uint32_t>(c_.cycle_begin.size() - 1) - first.index();
    const auto inside = static_cast<std::uint32_t>(c_.isolated_vertices.size()) - first_inside;
    c_.corners.insert(c_.corners.end(), known_->corners.begin() + known_->cycle_begin[first],
                      known_->corners.begin() + known_->cycle_begin[end]);
    for (CycleId i = first; i != end; ++i) c_.cycle_begin.push_back(known_->cycle_begin[i.next()] + base);
    c_.isolated_vertices.insert(c_.isolated_vertices.end(), known_->isolated_vertices.begin() + first_inside,
                                known_->isolated_vertices.begin() + end_inside);
    for (Facet facet : facets) {
      facet.plane = PlaneId{facet.plane.row() << 1U};
      facet.first_cycle = CycleId{facet.first_cycle.index() + cycles};
      facet.first_isolated += inside;
      c_.facets.push_back(facet);
    }
  }

  void link_plane(std::uint32_t row, std::span<const std::uint32_t> cycles,
                  std::span<const std::pair<std::uint32_t, std::uint32_t>> points) {
    if (cycles.size() == 1 && points.empty()) {
      emit(row, cycles, {});
      return;
    }
    const PlaneAxes axes(c_.planes, PlaneId{row << 1U});
    std::vector<std::uint32_t> facet_of(cycles.size(), kNone);  // number of the outer cycle, of each cycle
    std::vector<std::vector<std::uint32_t>> members;            // cycles of each facet, the outer one first
    for (std::uint32_t i = 0; i < cycles.size(); ++i) {
      classify(cycles_[cycles[i]], axes);
      if (!cycles_[cycles[i]].outer) continue;
      facet_of[i] = static_cast<std::uint32_t>(members.size());
      members.push_back({cycles[i]});
    }
    detail::require(!members.empty(), "a facet has an outer cycle", {{"vertex", cycles_[cycles[0]].lowest}});
    std::vector<std::vector<std::uint32_t>> inside(members.size());
    if (members.size() == 1) {
      for (std::uint32_t i = 0; i < cycles.size(); ++i) {
        if (facet_of[i] == kNone) members[0].push_back(cycles[i]);
      }
      for (const auto& point : points) inside[0].push_back(point.second);
    } else if (cycles.size() > members.size() || !points.empty()) {
      nest(row, cycles, points, facet_of);
      for (std::uint32_t i = 0; i < cycles.size(); ++i) {
        if (!cycles_[cycles[i]].outer) members[facet_of[i]].push_back(cycles[i]);
      }
      for (std::size_t i = 0; i < points.size(); ++i) inside[facet_of[cycles.size() + i]].push_back(points[i].second);
    }
    for (std::size_t k = 0; k < members.size(); ++k) emit(row, members[k], inside[k]);
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

  // Completes facet_of for the holes, and appends the facets of the points.
  void nest(std::uint32_t row, std::span<const std::uint32_t> cycles,
            std::span<const std::pair<std::uint32_t, std::uint32_t>> points,
            std::vector<std::uint32_t>& facet_of) const {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> cycle_of;  // of each corner, as a position in `cycles`
    std::vector<std::uint32_t> lowest;    // vertices of holes and points
    std::vector<std::uint32_t> asking;    // their positions in facet_of
    for (std::uint32_t i = 0; i < cycles.size(); ++i) {
      const CycleRecord& cycle = cycles_[cycles[i]];
      corners.insert(corners.end(), traced_.begin() + cycle.first, traced_.begin() + cycle.first + cycle.count);
      cycle_of.resize(corners.size(), i);
      if (cycle.outer) continue;
      lowest.push_back(cycle.lowest);
      asking.push_back(i);
    }
    for (const auto& point : points) {
      lowest.push_back(point.second);
      asking.push_back(static_cast<std::uint32_t>(facet_of.size()));
      facet_of.push_back(kNone);
    }
    for (const CornerBelow& below : corners_below(c_, PlaneId{row << 1U}, corners, lowest)) {
      const std::uint32_t facet = below.corner == kNone ? kNone : facet_of[cycle_of[below.corner]];
      detail::require(facet != kNone, "a hole lies in a facet", {{"vertex", lowest[below.query]}});
      facet_of[asking[below.query]] = facet;
    }
  }

  void emit(std::uint32_t row, std::span<const std::uint32_t> cycles, std::span<const std::uint32_t> inside) {
    Facet facet = begin_facet(row, cycles.size(), inside.size());
    for (const std::uint32_t i : cycles) add_cycle(std::span(traced_).subspan(cycles_[i].first, cycles_[i].count));
    end_facet(facet, inside);
  }

  [[nodiscard]] Facet begin_facet(std::uint32_t row, std::size_t cycles, std::size_t inside) const {
    Facet facet;
    facet.plane = PlaneId{row << 1U};
    facet.first_cycle = CycleId{c_.cycle_begin.size() - 1};
    facet.cycle_count = static_cast<std::uint32_t>(cycles);
    facet.first_isolated = static_cast<std::uint32_t>(c_.isolated_vertices.size());
    facet.isolated_count = static_cast<std::uint32_t>(inside);
    return facet;
  }

  void add_cycle(std::span<const std::uint32_t> corners) {
    c_.corners.insert(c_.corners.end(), corners.begin(), corners.end());
    c_.cycle_begin.push_back(static_cast<std::uint32_t>(c_.corners.size()));
  }

  void end_facet(Facet& facet, std::span<const std::uint32_t> inside) {
    c_.isolated_vertices.insert(c_.isolated_vertices.end(), inside.begin(), inside.end());
    c_.facets.push_back(facet);
  }

  // What follows from the corners of each facet and the vertices inside.
  void name_facets_of_corners() {
    constexpr std::size_t kTogether = 8192;
    c_.shalfedge_facet.assign(c_.shalfedges.size(), HalffacetId());
    parallel_for_ranges(c_.facets.size(), kTogether, threads_, [this](std::size_t first, std::size_t last) {
      for (auto f = static_cast<std::uint32_t>(first); f < last; ++f) {
        Facet& facet = c_.facets[FacetId{f}];
        const std::span<const std::uint32_t> corners = c_.corners_of(facet);
        facet.mark = c_.shalfedges[corners[0]].mark;
        for (const std::uint32_t corner : corners) {
          c_.shalfedge_facet.set(corner, halffacet_of(FacetId{f}, false));
        }
        for (const std::uint32_t v : c_.isolated_vertices_of(facet)) {
          for (const std::uint32_t l : {c_.vertices[v].sloops, c_.vertices[v].sloops + 1}) {
            c_.sloop_facet[l] = halffacet_of(FacetId{f}, c_.sloops[l].plane.flipped());
          }
        }
      }
    });
  }

  Complex& c_;
  const KnownLinks* known_;
  unsigned threads_;
  std::vector<std::uint32_t> traced_;
  std::vector<CycleRecord> cycles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> isolated_;  // (plane row, vertex)
};

}  // namespace

void link_facets(Complex& complex, unsigned threads) { FacetLinker(complex, nullptr, threads).run(); }

void link_facets(Complex& complex, const KnownLinks& known, unsigned threads) {
  FacetLinker(complex, &known, threads).run();
}

}  // namespace nef
