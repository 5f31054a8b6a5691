// SPDX-License-Identifier: Apache-2.0
//
// The complex of a cone is written down directly: every vertex is a meeting of known planes, and its
// sphere map has an arc for each facet there. Let u_k be the vertices of a ring, l_k = u_k x u_k+1
// its edges, M the left block of the matrix. Then, up to positive factors,
//   n_k = M^T l_k            the plane of edge k, positive towards the region;
//   r_k = det(M) n_i x n_j   the direction in which vertex k is seen, if l_i x l_j = +u_k;
//   e_k = det(M) n_k x m_3   the direction of edge k in a plane of constant depth (normal m_3).
// If the lines of sight are parallel, the third row of M vanishes, m_3 is the axis m_1 x m_2, and all this holds with
// det(M) = 1.
// With det(M) > 0, r_k -> r_k+1 turns counterclockwise about n_k, and counterclockwise in the
// image is counterclockwise about m_3; with det(M) < 0 both are reversed.
#include "apps/visual_hull/cones/cone.h"

#include "apps/visual_hull/scene/camera_planes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/visual_hull/cones/boundary_node.h"
#include "nef/base/error.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef::visual_hull {
namespace {

using nef::PlaneId;

struct Corner {
  std::uint32_t in_edge = 0;   ///< the ring's edge that ends here
  std::uint32_t out_edge = 0;  ///< the one that starts here
};

/// A point where one ring has a vertex, or several touch.
struct RayPlace {
  Point2 point;
  std::vector<Corner> corners;
};

struct RingEdge {
  Point2 from, to;
  std::uint32_t from_place = 0;
  std::uint32_t to_place = 0;
  PlaneId plane;
};

class ConeBuilder {
 public:
  ConeBuilder(const Camera& camera, const Silhouette& silhouette, const nef::Monitor& monitor)
      : positive_(camera.handedness() > 0), monitor_(monitor), builder_(planes_, monitor) {
    collect(silhouette);
    const CameraPlanes planes(camera);
    for (RingEdge& edge : edges_) {
      const auto [a, b, c, d] = planes.through(edge.from, edge.to);
      edge.plane = planes_.intern(a, b, c, d);
    }
    for (const RayPlace& place : places_) choose_ray_planes(place);
  }

  /// The solid between two depths.
  nef::Polyhedron frustum(const Camera& camera, const Rational& near, const Rational& far) {
    add_cap(camera, near, Cap::kNear);
    add_cap(camera, far, Cap::kFar);
    return finish();
  }

  /// The solid from the apex to a depth.
  nef::Polyhedron pyramid(const Camera& camera, const Rational& far) {
    add_apex(camera);
    add_cap(camera, far, Cap::kFar);
    return finish();
  }

 private:
  enum class Cap { kNear, kFar };

  // Straight vertices matter only where another ring touches.
  [[nodiscard]] std::vector<Ring> without_straight_vertices(const Silhouette& silhouette) const {
    std::map<Point2, int, decltype(&lexicographically_less)> count(&lexicographically_less);
    for (const Ring& ring : silhouette.rings) {
      for (const Point2& p : ring) ++count[p];
    }
    std::vector<Ring> rings;
    for (const Ring& ring : silhouette.rings) {
      const std::size_t n = ring.size();
      Ring kept;
      for (std::size_t i = 0; i < n; ++i) {
        const bool straight = orientation(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n], monitor_) == 0;
        if (!straight || count[ring[i]] > 1) kept.push_back(ring[i]);
      }
      rings.push_back(std::move(kept));
    }
    return rings;
  }

  void collect(const Silhouette& silhouette) {
    std::map<Point2, std::uint32_t, decltype(&lexicographically_less)> index(&lexicographically_less);
    for (const Ring& ring : without_straight_vertices(silhouette)) {
      const auto first = static_cast<std::uint32_t>(edges_.size());
      const auto n = static_cast<std::uint32_t>(ring.size());
      for (std::uint32_t i = 0; i < n; ++i) {
        const auto [it, is_new] = index.emplace(ring[i], static_cast<std::uint32_t>(places_.size()));
        if (is_new) places_.push_back({ring[i], {}});
        places_[it->second].corners.push_back({first + (i + n - 1) % n, first + i});
        edges_.push_back({ring[i], ring[(i + 1) % n], it->second, 0, PlaneId{}});
      }
      for (std::uint32_t i = 0; i < n; ++i) edges_[first + i].to_place = edges_[first + (i + 1) % n].from_place;
    }
  }

  // Two planes p, q with n_p x n_q along the ray of a place.
  void choose_ray_planes(const RayPlace& place) {
    std::vector<std::uint32_t> at;
    for (const Corner& corner : place.corners) {
      at.push_back(corner.in_edge);
      at.push_back(corner.out_edge);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = i + 1; j < at.size(); ++j) {
        const RingEdge& a = edges_[at[i]];
        const RingEdge& b = edges_[at[j]];
        if (a.plane.row() == b.plane.row()) continue;
        // The third component of l_a x l_b is the turn from one edge's direction to the other's.
        const Rational turn =
            (a.to.x() - a.from.x()) * (b.to.y() - b.from.y()) - (a.to.y() - a.from.y()) * (b.to.x() - b.from.x());
        const bool forward = (sgn(turn) > 0) == positive_;
        rays_.push_back(forward ? std::array{a.plane, b.plane} : std::array{b.plane, a.plane});
        return;
      }
    }
    NEF_ASSERT(false);  // where rings touch they do not overlap, so they have different lines
  }

  std::uint32_t add_node(PlaneId p, PlaneId q) { return add_boundary_node(map_, planes_, p, q); }

  // `left` is the mark on the positive side of the plane; the order is for a camera that is not mirrored.
  void add_arc(PlaneId plane, std::uint32_t source, std::uint32_t target, nef::LabelId left) {
    nef::Arrangement::Arc arc;
    arc.plane = plane;
    arc.source = positive_ ? source : target;
    arc.target = positive_ ? target : source;
    arc.mark = 1;
    arc.left = left;
    arc.right = static_cast<nef::LabelId>(1 - left);
    map_.arcs.push_back(arc);
  }

  void add_apex(const Camera& camera) {
    map_.clear();
    for (const auto& ray : rays_) add_node(ray[0], ray[1]);
    for (const RingEdge& edge : edges_) add_arc(edge.plane, edge.from_place, edge.to_place, 1);
    map_.centre = 1;
    builder_.add(camera.centre(), map_);
  }

  void add_cap(const Camera& camera, const Rational& depth, Cap cap) {
    const RationalPlane rational = plane_at_depth(camera, depth);
    const PlaneId plane = planes_.intern(rational.normal, rational.offset);
    for (std::size_t i = 0; i < places_.size(); ++i) add_cap_vertex(i, plane, cap);
  }

  void add_cap_vertex(std::size_t index, PlaneId cap_plane, Cap cap) {
    map_.clear();
    const RayPlace& place = places_[index];
    const auto& ray = rays_[index];
    // The edge along the ray goes on to the far cap, or back from it.
    const std::uint32_t along = cap == Cap::kNear ? add_node(ray[0], ray[1]) : add_node(ray[1], ray[0]);
    struct Spoke {
      std::uint32_t node;
      Point2 tip;
      bool outgoing;
    };
    std::vector<Spoke> spokes;
    for (const Corner& corner : place.corners) {
      const RingEdge& out = edges_[corner.out_edge];
      const RingEdge& in = edges_[corner.in_edge];
      // e_k = det(M) n_k x m_3, and its opposite for the edge that comes in.
      const std::uint32_t to_next = add_edge_node(out.plane, cap_plane, positive_);
      const std::uint32_t to_previous = add_edge_node(in.plane, cap_plane, !positive_);
      if (cap == Cap::kNear) {
        add_arc(out.plane, along, to_next, 1);
        add_arc(in.plane, to_previous, along, 1);
      } else {
        add_arc(out.plane, to_next, along, 1);
        add_arc(in.plane, along, to_previous, 1);
      }
      spokes.push_back({to_next, out.to, true});
      spokes.push_back({to_previous, in.from, false});
    }
    if (spokes.size() > 2) {
      const Point2& centre = place.point;
      std::sort(spokes.begin(), spokes.end(), [this, &centre](const Spoke& a, const Spoke& b) {
        const bool a_upper = upper_half(centre, a.tip);
        const bool b_upper = upper_half(centre, b.tip);
        return a_upper != b_upper ? a_upper : orientation(centre, a.tip, b.tip, monitor_) > 0;
      });
    }
    // The region is to the left of an outgoing edge, up to the next spoke, which comes in.
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (!spokes[i].outgoing) continue;
      const Spoke& next = spokes[(i + 1) % spokes.size()];
      NEF_ASSERT(!next.outgoing);
      add_arc(cap_plane, spokes[i].node, next.node, cap == Cap::kNear ? 1 : 0);
    }
    map_.centre = 1;
    builder_.add({ray[0], ray[1], cap_plane}, map_);
  }

  std::uint32_t add_edge_node(PlaneId side, PlaneId cap, bool side_first) {
    return side_first ? add_node(side, cap) : add_node(cap, side);
  }

  static bool upper_half(const Point2& centre, const Point2& tip) {
    const int dy = compare_coordinate(tip, centre, 1);
    return dy > 0 || (dy == 0 && compare_coordinate(tip, centre, 0) > 0);
  }

  nef::Polyhedron finish() { return nef::Polyhedron(builder_.finish(0)); }

  bool positive_;
  nef::Monitor monitor_;
  std::vector<RayPlace> places_;
  std::vector<RingEdge> edges_;
  std::vector<std::array<PlaneId, 2>> rays_;
  nef::PlaneTable planes_;
  nef::ComplexBuilder builder_;
  nef::Arrangement map_;
};

// A short number near `value`, in the direction of `sign`: caps beyond the box may lie anywhere.
Rational nearby(const Rational& value, int sign) {
  const double approximate = nef::nearest_double(value);
  int exponent = 0;
  const double mantissa = std::frexp(approximate, &exponent);
  const double step = std::ldexp(1.0, exponent - 8);
  const double rounded = std::ldexp(std::round(mantissa * 256), exponent - 8);
  return nef::exact_rational(rounded + 2 * sign * step);
}

}  // namespace

DepthRange depth_range(const Camera& camera, const WorldBox& box) {
  DepthRange range;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Rational3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] = (corner >> axis & 1U) != 0 ? box.high[axis] : box.low[axis];
    }
    const Rational depth = camera.depth(point);
    if (corner == 0 || depth < range.nearest) range.nearest = depth;
    if (corner == 0 || depth > range.farthest) range.farthest = depth;
  }
  return range;
}

nef::Polyhedron make_cone(const Camera& camera, const Silhouette& silhouette, const WorldBox& box,
                          const nef::Monitor& monitor) {
  const DepthRange range = depth_range(camera, box);
  if (camera.is_parallel() && !silhouette.empty()) {
    ConeBuilder builder(camera, silhouette, monitor);
    return builder.frustum(camera, nearby(range.nearest, -1), nearby(range.farthest, 1));
  }
  // At depth 0 only the centre itself may be in the box: the apex alone, which is no solid.
  if (silhouette.empty() || sgn(range.farthest) < 0) return {};
  ConeBuilder builder(camera, silhouette, monitor);
  const Rational far = sgn(range.farthest) > 0 ? nearby(range.farthest, 1) : Rational(1);
  if (sgn(range.nearest) > 0) {
    const Rational near = nearby(range.nearest, -1);
    if (sgn(near) > 0) return builder.frustum(camera, near, far);
  }
  return builder.pyramid(camera, far);
}

}  // namespace nef::visual_hull
