// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/plane_sweep.h"

#include <algorithm>
#include <set>

#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

// An edge with its facet above. Vertices are known by their rank in the order of the sweep.
struct SweepEdge {
  std::uint32_t corner = kNone;  // index into the corners that were given
  HalfedgeId outgoing;           // the halfedge at the low end
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  EdgeSide side;  // of the halfedge whose left is above
};

class PlaneSweep {
 public:
  PlaneSweep(const Complex& complex, PlaneId plane, const Monitor& monitor)
      : c_(complex), plane_(plane), axes_(complex.planes, plane), monitor_(monitor) {}

  std::vector<CornerBelow> run(std::span<const SHalfedgeId> corners, std::span<const VertexId> vertices) {
    rank_vertices(corners, vertices);
    collect_edges(corners);
    std::vector<std::uint32_t> query_at(order_.size(), kNone);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) query_at[rank_of(vertices[i])] = i;
    return sweep(query_at, vertices.size());
  }

 private:
  void rank_vertices(std::span<const SHalfedgeId> corners, std::span<const VertexId> vertices) {
    // The other end of an edge is the vertex of another corner.
    for (const SHalfedgeId corner : corners) ids_.push_back(c_.shalfedge_vertex(corner));
    ids_.insert(ids_.end(), vertices.begin(), vertices.end());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    order_ = ids_;
    std::sort(order_.begin(), order_.end(), [this](VertexId a, VertexId b) {
      return axes_.compare(c_.points, point_of(a), point_of(b), monitor_) < 0;
    });
    ranks_.resize(ids_.size());
    for (std::uint32_t rank = 0; rank < order_.size(); ++rank) ranks_[position_of(order_[rank])] = rank;
  }

  std::size_t position_of(VertexId vertex) const {
    return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), vertex) - ids_.begin());
  }
  std::uint32_t rank_of(VertexId vertex) const { return ranks_[position_of(vertex)]; }

  // A facet lies to the left of the halfedge of its corner: above it if the halfedge ascends in axes that turn
  // counterclockwise, or descends in others.
  void collect_edges(std::span<const SHalfedgeId> corners) {
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const HalfedgeId halfedge = c_.corner_halfedge(corners[i]);
      const std::uint32_t from = rank_of(c_.shalfedge_vertex(corners[i]));
      const std::uint32_t to = rank_of(c_.target(halfedge));
      if ((from < to) != axes_.positive) continue;
      edges_.push_back({i, axes_.positive ? halfedge : c_.twin[halfedge], std::min(from, to), std::max(from, to),
                        edge_side(c_.planes, plane_, c_.svertex(halfedge), monitor_)});
    }
  }

  // True if the vertex lies above the line of the edge.
  bool below_vertex(const SweepEdge& edge, std::uint32_t rank) const {
    return edge.side.left * side_of_plane(c_.planes, edge.side.other, c_.points, point_of(order_[rank]), monitor_) > 0;
  }

  // For two edges that one sweep line meets.
  bool below_edge(const SweepEdge& a, const SweepEdge& b) const {
    if (a.low < b.low) return below_vertex(a, b.low);
    if (a.low > b.low) return !below_vertex(b, a.low);
    const int turn = orientation_on_circle(c_.planes, plane_, direction_of(c_.planes, c_.svertex(a.outgoing)),
                                           direction_of(c_.planes, c_.svertex(b.outgoing)), monitor_);
    return axes_.positive ? turn > 0 : turn < 0;
  }

  std::vector<CornerBelow> sweep(const std::vector<std::uint32_t>& query_at, std::size_t query_count) const {
    struct Below {
      using is_transparent = void;
      const PlaneSweep* sweep;
      bool operator()(std::uint32_t a, std::uint32_t b) const {
        return sweep->below_edge(sweep->edges_[a], sweep->edges_[b]);
      }
      // Searched with the rank of a vertex, as a type of its own.
      bool operator()(std::uint32_t a, PointId rank) const {
        return sweep->below_vertex(sweep->edges_[a], rank.index());
      }
    };
    std::multiset<std::uint32_t, Below> line(Below{this});
    std::vector<std::multiset<std::uint32_t, Below>::iterator> place(edges_.size());
    const std::vector<std::uint32_t> begins = sorted_edges(&SweepEdge::low);
    const std::vector<std::uint32_t> ends = sorted_edges(&SweepEdge::high);
    auto beginning = begins.begin();
    auto ending = ends.begin();
    std::vector<CornerBelow> result;
    result.reserve(query_count);
    for (std::uint32_t rank = 0; rank < order_.size() && result.size() < query_count; ++rank) {
      for (; ending != ends.end() && edges_[*ending].high == rank; ++ending) line.erase(place[*ending]);
      if (query_at[rank] != kNone) {
        const auto above = line.lower_bound(PointId{rank});
        result.push_back({query_at[rank], above == line.begin() ? kNone : edges_[*std::prev(above)].corner});
      }
      for (; beginning != begins.end() && edges_[*beginning].low == rank; ++beginning) {
        place[*beginning] = line.insert(*beginning);
      }
    }
    return result;
  }

  std::vector<std::uint32_t> sorted_edges(std::uint32_t SweepEdge::*end) const {
    std::vector<std::uint32_t> sorted(edges_.size());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) sorted[i] = i;
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      return edges_[a].*end != edges_[b].*end ? edges_[a].*end < edges_[b].*end : a < b;
    });
    return sorted;
  }

  const Complex& c_;
  PlaneId plane_;
  PlaneAxes axes_;
  Monitor monitor_;
  std::vector<VertexId> ids_;         // of the vertices, ascending
  std::vector<std::uint32_t> ranks_;  // of ids_
  std::vector<VertexId> order_;       // ids by rank
  std::vector<SweepEdge> edges_;
};

}  // namespace

std::vector<CornerBelow> corners_below(const Complex& complex, PlaneId plane, std::span<const SHalfedgeId> corners,
                                       std::span<const VertexId> vertices, const Monitor& monitor) {
  return PlaneSweep(complex, plane, monitor).run(corners, vertices);
}

}  // namespace nef
