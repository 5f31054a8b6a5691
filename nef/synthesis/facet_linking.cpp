// SPDX-License-Identifier: Apache-2.0
//
// A cycle is an outer one iff it turns left at its lexicographically smallest vertex, at each of
// its corners there: the facet then lies within a half-plane. Most planes hold one outer cycle
// only, which owns all holes of the plane. Otherwise a hole, or a vertex inside a facet, sees its
// facet straight below its lowest vertex, and the first edge on the way down bounds that facet, too:
// it belongs where the cycle of that edge belongs, which begins further down in lexicographic order.
//
// Planes have nothing to do with each other, so several threads have ranges of them; what these find is put together in
// the order of the planes.
#include "nef/synthesis/facet_linking.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "nef/base/defect.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/threads/shared_out.h"
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
  bool is_known = false;  // whether it is an outer one
  VertexId lowest;        // lexicographically; not valid until somebody needs it
};

bool few(const Complex& c) { return c.shalfedge_count() < 1U << 15U; }  // one share does

/// Some facets, numbered from 0 on, as the complex holds all of them.
struct LinkedFacets {
  FacetTable facets;
  std::vector<std::uint32_t> cycle_begin{0};
  std::vector<SHalfedgeId> corners;
  std::vector<VertexId> isolated_vertices;
};

/// Corners of facets and vertices inside facets, those of some planes.
struct Share {
  std::vector<SHalfedgeId> corners;  // shalfedges whose planes are not flipped, ascending
  std::vector<VertexId> isolated;    // ascending
  std::uint32_t first_row = 0;       // of the planes
  std::uint32_t end_row = 0;
};

class FacetLinker {
 public:
  /// `known` may be null. `done` has a place for each shalfedge, unset for those of the share.
  FacetLinker(const Complex& complex, const KnownLinks* known, IndexedVector<SHalfedgeId, std::uint8_t>& done,
              const Monitor& monitor)
      : c_(complex), known_(known), done_(done), monitor_(monitor) {}

  LinkedFacets run(const Share& share) {
    trace_cycles(share.corners);
    for (const VertexId v : share.isolated) {
      isolated_.emplace_back(c_.sloops[c_.vertices[v].sloops].plane.row(), v);
    }
    group_by_plane(share);
    return std::move(result_);
  }

 private:
  struct Corner {
    SHalfedgeId shalfedge;
    VertexId vertex;
  };

  // Reads patterns, not sphere maps: it is asked for every corner.
  [[nodiscard]] Corner next(const Corner& corner) const {
    const std::uint32_t local = corner.shalfedge - c_.vertices.shalfedges(corner.vertex);
    const HalfedgeId ahead =
        c_.vertices.svertices(corner.vertex) + c_.patterns.shalfedge(c_.vertices.pattern(corner.vertex), local).source;
    const HalfedgeId there = c_.twin[ahead];
    const VertexId vertex = c_.source(there);
    const PatternId pattern = c_.vertices.pattern(vertex);
    const SHalfedgeId base = c_.vertices.shalfedges(vertex);
    const PlaneId wanted = c_.shalfedge_plane[corner.shalfedge].opposite();
    const std::uint32_t first = c_.patterns.svertex(pattern, there - c_.vertices.svertices(vertex)).out;
    std::uint32_t e = first;
    while (c_.shalfedge_plane[base + e] != wanted) {
      e = c_.patterns.shalfedge(pattern, e).prev ^ 1U;  // the next around the svertex
      detail::require(e != first, "a facet goes on along its edges", {{"shalfedge", corner.shalfedge}});
    }
    return {base + (e ^ 1U), vertex};
  }

  void trace_cycles(std::span<const SHalfedgeId> corners) {
    traced_.reserve(corners.size());
    for (const SHalfedgeId first : corners) {
      if (done_[first] != 0) continue;
      CycleRecord cycle;
      cycle.row = c_.shalfedge_plane[first].row();
      cycle.first = static_cast<std::uint32_t>(traced_.size());
      Corner corner{first, c_.shalfedge_vertex(first)};
      for (; done_[corner.shalfedge] == 0; corner = next(corner)) {
        done_[corner.shalfedge] = 1;
        traced_.push_back(corner.shalfedge);
      }
      detail::require(corner.shalfedge == first, "cycles of facets are disjoint",
                      {{"shalfedge", first}, {"shalfedge", corner.shalfedge}});
      cycle.count = static_cast<std::uint32_t>(traced_.size()) - cycle.first;
      cycles_.push_back(cycle);
    }
  }

  // Counting sort by plane row, so that the order of facets depends on nothing but the input. Known facets between two
  // planes that hold anything else are taken over together.
  void group_by_plane(const Share& share) {
    const std::size_t rows = share.end_row - share.first_row;
    std::vector<std::uint32_t> start(rows + 1, 0);
    for (const CycleRecord& cycle : cycles_) ++start[cycle.row - share.first_row + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    std::vector<std::uint32_t> order(cycles_.size());
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    for (std::uint32_t i = 0; i < cycles_.size(); ++i) order[at[cycles_[i].row - share.first_row]++] = i;
    std::sort(isolated_.begin(), isolated_.end());
    const std::span<const Facet> known = known_ == nullptr ? std::span<const Facet>() : known_->facets;
    const std::span<const std::uint32_t> mixed =
        known_ == nullptr ? std::span<const std::uint32_t>() : known_->mixed_rows;
    result_.facets.reserve(cycles_.size() + known.size());
    result_.cycle_begin.reserve(cycles_.size() + 1 + (known_ == nullptr ? 0 : known_->cycle_begin.size()));
    result_.corners.reserve(traced_.size() + (known_ == nullptr ? 0 : known_->corners.size()));
    auto isolated = isolated_.begin();
    auto next_mixed = mixed.begin();
    auto kept = known.begin();
    for (std::size_t i = 0; i < rows; ++i) {
      const std::uint32_t row = share.first_row + static_cast<std::uint32_t>(i);
      const bool is_mixed = next_mixed != mixed.end() && *next_mixed == row;
      const bool has_points = isolated != isolated_.end() && isolated->first == row;
      if (start[i] == start[i + 1] && !is_mixed && !has_points) continue;
      if (is_mixed) ++next_mixed;
      const auto first = isolated;
      while (isolated != isolated_.end() && isolated->first == row) ++isolated;
      const std::span<const std::uint32_t> cycles(order.data() + start[i], start[i + 1] - start[i]);
      const std::span<const std::pair<std::uint32_t, VertexId>> points(first, isolated);
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
                      {{"vertex", points.empty() ? VertexId{0} : points[0].second}});
    }
    emit_known({kept, known.end()});
  }

  // Known facets in a plane with others are linked anew, with these, which may be holes of theirs.
  void link_plane_with_known(std::uint32_t row, std::span<const std::uint32_t> cycles,
                             std::span<const std::pair<std::uint32_t, VertexId>> points,
                             std::span<const Facet> facets) {
    std::vector<std::uint32_t> all(cycles.begin(), cycles.end());
    std::vector<std::pair<std::uint32_t, VertexId>> inside(points.begin(), points.end());
    for (const Facet& facet : facets) {
      for (const CycleId i : facet.cycles()) {
        CycleRecord cycle;
        cycle.row = row;
        cycle.first = static_cast<std::uint32_t>(traced_.size());
        cycle.count = known_->cycle_begin[i.next()] - known_->cycle_begin[i];
        cycle.outer = i == facet.first_cycle;
        cycle.is_known = true;
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
    const auto base = static_cast<std::uint32_t>(result_.corners.size()) - known_->cycle_begin[first];  // modulo 2^32
    result_.corners.insert(result_.corners.end(), known_->corners.begin() + known_->cycle_begin[first],
                           known_->corners.begin() + known_->cycle_begin[end]);
    for (CycleId i = first; i != end; ++i) result_.cycle_begin.push_back(known_->cycle_begin[i.next()] + base);
    result_.isolated_vertices.insert(result_.isolated_vertices.end(), known_->isolated_vertices.begin() + first_inside,
                                     known_->isolated_vertices.begin() + end_inside);
    for (Facet facet : facets) {
      facet.plane = facet.plane.unflipped();
      result_.facets.push_back(facet);
    }
  }

  void link_plane(std::uint32_t row, std::span<const std::uint32_t> cycles,
                  std::span<const std::pair<std::uint32_t, VertexId>> points) {
    if (cycles.size() == 1 && points.empty()) {
      emit(row, cycles, {});
      return;
    }
    const PlaneAxes axes(c_.planes, PlaneId::of_row(row));
    std::vector<std::uint32_t> facet_of(cycles.size(), kNone);  // number of the outer cycle, of each cycle
    std::vector<std::vector<std::uint32_t>> members;            // cycles of each facet, the outer one first
    for (std::uint32_t i = 0; i < cycles.size(); ++i) {
      classify(cycles_[cycles[i]], axes);
      if (!cycles_[cycles[i]].outer) continue;
      facet_of[i] = static_cast<std::uint32_t>(members.size());
      members.push_back({cycles[i]});
    }
    detail::require(!members.empty(), "a facet has an outer cycle",
                    {{"vertex", c_.shalfedge_vertex(traced_[cycles_[cycles[0]].first])}});
    std::vector<std::vector<VertexId>> inside(members.size());
    if (members.size() == 1) {
      for (std::uint32_t i = 0; i < cycles.size(); ++i) {
        if (facet_of[i] == kNone) members[0].push_back(cycles[i]);
      }
      for (const auto& point : points) inside[0].push_back(point.second);
    } else if (cycles.size() > members.size() || !points.empty()) {
      for (const std::uint32_t i : cycles) {
        if (!cycles_[i].outer) find_lowest(cycles_[i], axes);
      }
      nest(row, cycles, points, facet_of);
      for (std::uint32_t i = 0; i < cycles.size(); ++i) {
        if (!cycles_[cycles[i]].outer) members[facet_of[i]].push_back(cycles[i]);
      }
      for (std::size_t i = 0; i < points.size(); ++i) inside[facet_of[cycles.size() + i]].push_back(points[i].second);
    }
    for (std::size_t k = 0; k < members.size(); ++k) emit(row, members[k], inside[k]);
  }

  [[nodiscard]] std::span<const SHalfedgeId> corners_of(const CycleRecord& cycle) const {
    return std::span(traced_).subspan(cycle.first, cycle.count);
  }

  void find_lowest(CycleRecord& cycle, const PlaneAxes& axes) const {
    if (cycle.lowest.valid()) return;
    for (const SHalfedgeId corner : corners_of(cycle)) {
      const VertexId v = c_.shalfedge_vertex(corner);
      if (v == cycle.lowest) continue;
      if (!cycle.lowest.valid() || axes.compare(c_.points, point_of(v), point_of(cycle.lowest), monitor_) < 0) {
        cycle.lowest = v;
      }
    }
  }

  void classify(CycleRecord& cycle, const PlaneAxes& axes) const {
    if (cycle.is_known) return;
    find_lowest(cycle, axes);
    cycle.outer = true;
    for (const SHalfedgeId corner : corners_of(cycle)) {
      if (c_.shalfedge_vertex(corner) != cycle.lowest) continue;
      const HalfedgeId ahead = c_.corner_halfedge(corner);
      const HalfedgeId back = c_.corner_back_halfedge(corner);
      if (ahead == back ||
          orientation_on_circle(c_.planes, c_.shalfedge_plane[corner], direction_of(c_.planes, c_.svertex(ahead)),
                                direction_of(c_.planes, c_.svertex(back)), monitor_) <= 0) {
        cycle.outer = false;
        return;
      }
    }
  }

  // Completes facet_of for the holes, and appends the facets of the points.
  void nest(std::uint32_t row, std::span<const std::uint32_t> cycles,
            std::span<const std::pair<std::uint32_t, VertexId>> points, std::vector<std::uint32_t>& facet_of) const {
    std::vector<SHalfedgeId> corners;
    std::vector<std::uint32_t> cycle_of;  // of each corner, as a position in `cycles`
    std::vector<VertexId> lowest;         // vertices of holes and points
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
    for (const CornerBelow& below : corners_below(c_, PlaneId::of_row(row), corners, lowest, monitor_)) {
      const std::uint32_t facet = below.corner == kNone ? kNone : facet_of[cycle_of[below.corner]];
      detail::require(facet != kNone, "a hole lies in a facet", {{"vertex", lowest[below.query]}});
      facet_of[asking[below.query]] = facet;
    }
  }

  void emit(std::uint32_t row, std::span<const std::uint32_t> cycles, std::span<const VertexId> inside) {
    Facet facet;
    facet.plane = PlaneId::of_row(row);
    facet.cycle_count = static_cast<std::uint32_t>(cycles.size());
    facet.isolated_count = static_cast<std::uint32_t>(inside.size());
    result_.facets.push_back(facet);
    for (const std::uint32_t i : cycles) add_cycle(std::span(traced_).subspan(cycles_[i].first, cycles_[i].count));
    result_.isolated_vertices.insert(result_.isolated_vertices.end(), inside.begin(), inside.end());
  }

  void add_cycle(std::span<const SHalfedgeId> corners) {
    result_.corners.insert(result_.corners.end(), corners.begin(), corners.end());
    result_.cycle_begin.push_back(static_cast<std::uint32_t>(result_.corners.size()));
  }

  const Complex& c_;
  const KnownLinks* known_;
  IndexedVector<SHalfedgeId, std::uint8_t>& done_;
  Monitor monitor_;
  std::vector<SHalfedgeId> traced_;
  std::vector<CycleRecord> cycles_;
  std::vector<std::pair<std::uint32_t, VertexId>> isolated_;  // (plane row, vertex)
  LinkedFacets result_;
};

// All corners and vertices inside facets, or those that known facets do not have.
Share everything(const Complex& c, const KnownLinks* known) {
  Share all;
  all.end_row = static_cast<std::uint32_t>(c.planes.size());
  if (known != nullptr) {
    all.corners = known->loose_corners;
    std::erase_if(all.corners, [&c](SHalfedgeId e) { return c.shalfedge_plane[e].flipped(); });
    all.isolated = known->loose_isolated;
    std::erase_if(all.isolated, [&c](VertexId v) { return c.vertices[v].sloops == c.vertices[v.next()].sloops; });
    return all;
  }
  all.corners.reserve(c.shalfedge_count() / 2);
  for (const SHalfedgeId e : c.shalfedge_ids()) {
    if (!c.shalfedge_plane[e].flipped()) all.corners.push_back(e);
  }
  for (const VertexId v : c.vertex_ids()) {
    if (c.vertices[v].sloops != c.vertices[v.next()].sloops) all.isolated.push_back(v);
  }
  return all;
}

std::vector<Share> shares_of(const Complex& c, const Monitor& monitor) {
  const std::size_t rows = (c.planes.size() + kShares - 1) / kShares;
  auto corners = shared_out<SHalfedgeId>(c.shalfedge_count(), monitor, [&](std::size_t i, const auto& put) {
    const SHalfedgeId e{i};
    const PlaneId plane = c.shalfedge_plane[e];
    if (!plane.flipped()) put(plane.row() / rows, e);
  });
  std::vector<Share> shares(kShares);
  for (std::size_t s = 0; s < kShares; ++s) {
    shares[s].corners = std::move(corners[s]);
    shares[s].first_row = static_cast<std::uint32_t>(std::min(s * rows, c.planes.size()));
    shares[s].end_row = static_cast<std::uint32_t>(std::min((s + 1) * rows, c.planes.size()));
  }
  for (const VertexId v : c.vertex_ids()) {
    if (c.vertices[v].sloops == c.vertices[v.next()].sloops) continue;
    shares[c.sloops[c.vertices[v].sloops].plane.row() / rows].isolated.push_back(v);
  }
  return shares;
}

// Behind the facets that are there.
void append(const LinkedFacets& more, Complex& c) {
  const auto first_corner = static_cast<std::uint32_t>(c.corners.size());
  c.facets.append(more.facets);
  for (std::size_t i = 1; i < more.cycle_begin.size(); ++i) c.cycle_begin.push_back(first_corner + more.cycle_begin[i]);
  c.corners.insert(c.corners.end(), more.corners.begin(), more.corners.end());
  c.isolated_vertices.insert(c.isolated_vertices.end(), more.isolated_vertices.begin(), more.isolated_vertices.end());
}

void put_together(std::vector<LinkedFacets>& parts, Complex& c) {
  if (parts.size() == 1) {
    c.facets = std::move(parts[0].facets);
    c.cycle_begin.values() = std::move(parts[0].cycle_begin);
    c.corners = std::move(parts[0].corners);
    c.isolated_vertices = std::move(parts[0].isolated_vertices);
    return;
  }
  std::array<std::size_t, 3> sizes{};
  for (const LinkedFacets& part : parts) {
    sizes[0] += part.facets.size();
    sizes[1] += part.cycle_begin.size();
    sizes[2] += part.corners.size();
  }
  c.facets.clear();
  c.cycle_begin.assign(1, 0);
  c.corners.clear();
  c.isolated_vertices.clear();
  c.facets.reserve(sizes[0]);
  c.cycle_begin.reserve(sizes[1]);
  c.corners.reserve(sizes[2]);
  for (const LinkedFacets& part : parts) append(part, c);
}

// Tells shalfedges and sloops their facets.
void name_facets(Complex& c, const Monitor& monitor) {
  c.shalfedge_facet.assign(c.shalfedge_count(), HalffacetId());
  c.sloop_facet.assign(c.sloops.size(), HalffacetId());
  const std::size_t tasks = few(c) ? 1 : kShares;
  const std::size_t range = (c.facets.size() + tasks - 1) / tasks;
  parallel_for(tasks, monitor, [&](std::size_t k, const Monitor&) {
    const FacetId end{std::min((k + 1) * range, c.facets.size())};
    for (FacetId f{k * range}; f < end; ++f) {
      const std::span<const SHalfedgeId> corners = c.corners_of(f);
      for (const SHalfedgeId corner : corners) c.shalfedge_facet.set(corner, halffacet_of(f, false));
      for (const VertexId v : c.isolated_vertices_of(c.facets[f])) {
        const std::uint32_t loop = c.vertices[v].sloops;
        for (std::uint32_t l = loop; l < loop + 2; ++l) {
          c.sloop_facet[l] = halffacet_of(f, c.sloops[l].plane.flipped());
        }
      }
    }
  });
}

void link(Complex& c, const KnownLinks* known, const Monitor& monitor) {
  std::vector<Share> shares;
  if (known != nullptr || monitor.threads() == 1 || few(c)) {
    shares.push_back(everything(c, known));
  } else {
    shares = shares_of(c, monitor);
  }
  IndexedVector<SHalfedgeId, std::uint8_t> done(c.shalfedge_count(), 0);
  std::vector<LinkedFacets> parts(shares.size());
  parallel_for(shares.size(), monitor, [&](std::size_t s, const Monitor& own) {
    parts[s] = FacetLinker(c, known, done, own).run(std::exchange(shares[s], {}));
  });
  put_together(parts, c);
  name_facets(c, monitor);
}

}  // namespace

void link_facets(Complex& complex, const Monitor& monitor) { link(complex, nullptr, monitor); }

void link_facets(Complex& complex, const KnownLinks& known, const Monitor& monitor) { link(complex, &known, monitor); }

}  // namespace nef
