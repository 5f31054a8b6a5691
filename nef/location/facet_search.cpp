// SPDX-License-Identifier: Apache-2.0
//
// Parity along a ray inside the facet's plane F. With l the axis of the largest component of n_F,
// k and m the other two (cyclically after l), the ray runs from the point where coordinate k stays
// constant and coordinate m grows. All that is asked of a boundary edge is on which side of the
// point its two ends lie in coordinate k, and on which side of a second plane G through the edge
// the point lies: no coordinates are computed.
//
// Let r = n_F x e_k, the direction of constant k in F; r_m = n_F[l]. An edge that straddles the
// point in k meets the ray's line at X = point + lambda r, and G(X) = 0 gives
// lambda = -G(point) / (n_G . r) with n_G . r = (n_G x n_F)_k.
#include "nef/location/facet_search.h"

#include <cmath>
#include <vector>

#include "nef/complex/facet_plane.h"
#include "nef/complex/item_boxes.h"

namespace nef {
namespace {

// Sign of component k of n_g x n_f.
int sign_of_cross_component(const PlaneTable& planes, PlaneId g, PlaneId f, std::size_t k, const Monitor& monitor) {
  const Direction cross = Direction::cross(planes, g, f);
  return sign_by_ladder({cross.approximate[k], cross.error}, monitor, [&] { return sgn(cross.integers()[k]); });
}

class ParityCount {
 public:
  ParityCount(const Complex& complex, FacetId facet, const PointRef& point, const Monitor& monitor)
      : complex_(complex), id_(facet), facet_(complex.facets[facet]), point_(point), monitor_(monitor) {
    const PlaneAxes axes(complex.planes, facet_.plane);
    k_ = static_cast<std::size_t>(axes.first);
    m_ = static_cast<std::size_t>(axes.second);
    ray_sign_ = axes.positive ? 1 : -1;
    const std::array<double, 3>& x = point.approximate();
    for (std::size_t i = 0; i < 3; ++i) {
      const double margin = std::fabs(x[i]) * 0x1p-48 + 1e-290;
      low_[i] = x[i] - margin;
      high_[i] = x[i] + margin;
    }
  }

  // True if the edge in `box` can hold the point or meet the ray.
  [[nodiscard]] bool may_matter(const Box& box, const Box& query) const {
    return box.low[k_] <= query.high[k_] && query.low[k_] <= box.high[k_] && query.low[m_] <= box.high[m_];
  }

  // True if doubles tell that an edge neither holds the point nor meets the ray: both ends lie on one
  // side in k, or behind the point in m. Doubles are within 2^-51 relative of the truth on both
  // sides, so a gap of 2^-48 of the point's coordinate settles it; a NaN does not.
  [[nodiscard]] bool clear(VertexId u, VertexId v) const {
    const std::array<double, 3>& a = complex_.points.approximate(point_of(u));
    const std::array<double, 3>& b = complex_.points.approximate(point_of(v));
    return (a[k_] < low_[k_] && b[k_] < low_[k_]) || (a[k_] > high_[k_] && b[k_] > high_[k_]) ||
           (a[m_] < low_[m_] && b[m_] < low_[m_]);
  }

  void add(SHalfedgeId corner) {
    const VertexId u = complex_.shalfedge_vertex(corner);
    const HalfedgeId halfedge = complex_.corner_halfedge(corner);
    const VertexId v = complex_.target(halfedge);
    const int u_side = compare(u, k_);
    const int v_side = compare(v, k_);
    if (u_side * v_side > 0) return;
    if (u_side == 0 || v_side == 0) {
      if (meets_at_height(u, u_side, v, v_side, halfedge)) return;
      if ((u_side > 0) == (v_side > 0)) return;
    }
    const SVertex& edge = complex_.svertex(halfedge);
    const bool facet_first = edge.p.row() == facet_.plane.row();
    const PlaneId g = facet_first ? edge.q : edge.p;
    const int g_side = side_of_plane(complex_.planes, g, point_, monitor_);
    if (g_side == 0) {
      place_ = ItemRef(halfedge);
      return;
    }
    // The edge runs along n_p x n_q. If F is one of these planes, the way that the edge goes in k tells
    // the sign of (n_G x n_F)_k.
    int turn = v_side > u_side ? 1 : -1;
    if (facet_first) {
      if (!edge.p.flipped()) turn = -turn;
    } else if (edge.q.row() == facet_.plane.row()) {
      if (edge.q.flipped()) turn = -turn;
    } else {
      turn = sign_of_cross_component(complex_.planes, g, facet_.plane, k_, monitor_);
    }
    if (-g_side * turn * ray_sign_ > 0) inside_ = !inside_;
  }

  [[nodiscard]] bool on_boundary() const { return place_.valid(); }

  [[nodiscard]] ItemRef place() const { return on_boundary() || !inside_ ? place_ : ItemRef(id_); }

 private:
  [[nodiscard]] int compare(VertexId vertex, std::size_t axis) const {
    return compare_coordinate(PointRef{&complex_.points, point_of(vertex)}, point_, static_cast<int>(axis), monitor_);
  }

  // An end (or both) at the height of the point: is the point on the edge? On the plane of the
  // facet, coordinates k and m tell points apart.
  bool meets_at_height(VertexId u, int u_side, VertexId v, int v_side, HalfedgeId halfedge) {
    const int u_along = u_side == 0 ? compare(u, m_) : 1;
    const int v_along = v_side == 0 ? compare(v, m_) : 1;
    if (u_along == 0) {
      place_ = ItemRef(u);
    } else if (v_along == 0) {
      place_ = ItemRef(v);
    } else if (u_side == 0 && v_side == 0 && u_along != v_along) {
      place_ = ItemRef(halfedge);
    }
    return on_boundary();
  }

  const Complex& complex_;
  FacetId id_;
  Facet facet_;
  const PointRef& point_;
  Monitor monitor_;
  std::size_t k_ = 0;
  std::size_t m_ = 0;
  int ray_sign_ = 1;
  std::array<double, 3> low_{};
  std::array<double, 3> high_{};
  bool inside_ = false;
  ItemRef place_;  // on the boundary
};

}  // namespace

ItemRef locate_in_facet(const Complex& complex, FacetId f, const PointRef& point, const BoxTree* edges,
                        const Monitor& monitor) {
  const Facet& facet = complex.facets[f];
  ParityCount count(complex, f, point, monitor);
  if (edges == nullptr) {
    for (const CycleId c : facet.cycles()) {
      if (count.on_boundary()) break;
      const std::span<const SHalfedgeId> cycle = complex.corners_of(c);
      VertexId v = complex.shalfedge_vertex(cycle.front());
      for (std::size_t i = 0; i < cycle.size() && !count.on_boundary(); ++i) {
        const VertexId u = v;
        v = complex.shalfedge_vertex(i + 1 < cycle.size() ? cycle[i + 1] : cycle.front());
        if (!count.clear(u, v)) count.add(cycle[i]);
      }
    }
  } else {
    const std::span<const SHalfedgeId> corners = complex.corners_of(facet);
    const Box query = point_box(point);
    edges->for_each_if([&](const Box& box) { return !count.on_boundary() && count.may_matter(box, query); },
                       [&](std::uint32_t i) { count.add(corners[i]); });
  }
  return count.place();
}

BoxTree facet_edge_tree(const Complex& complex, const Facet& facet) {
  std::vector<Box> boxes;
  const std::span<const SHalfedgeId> corners = complex.corners_of(facet);
  boxes.reserve(corners.size());
  for (const SHalfedgeId corner : corners) boxes.push_back(edge_box(complex, complex.corner_halfedge(corner)));
  return BoxTree(boxes);
}

Box mirrored(const Box& box) {
  Box result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] = -box.high[i];
    result.high[i] = -box.low[i];
  }
  return result;
}

Box point_box(const PointRef& point) {
  Box box;
  box.add_rounded(point.approximate());
  return box;
}

}  // namespace nef
