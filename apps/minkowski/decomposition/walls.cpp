// SPDX-License-Identifier: Apache-2.0
//
// Rounds of two kinds (thesis 10.2.2): while there are reflex edges that are not parallel to the axis, each gets its
// sight walls; afterwards the vertical ones get cross walls. All walls of a round are one surface, which a single
// overlay inserts. Among cross walls the plane that serves most edges comes first (a greedy cover), since one wall
// often does for several edges.
//
// Facets are cut in the same way: a segment from each reflex corner, in both directions, to the next point of the
// facet's boundary.
#include "apps/minkowski/decomposition/walls.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "apps/minkowski/decomposition/reflex.h"
#include "apps/minkowski/decomposition/wall_builder.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// Inside the set, what meets `parts` gets `bit`; nothing is added outside of it.
Polyhedron insert(const Polyhedron& a, const Polyhedron& parts, LabelId bit, const Monitor& monitor) {
  const auto with_bit = [bit](LabelId own, LabelId part) -> LabelId {
    if ((own & kSelected) == 0 || own == kOutside) return own;
    return part != 0 ? static_cast<LabelId>(own | bit) : own;
  };
  return overlay(a, parts, with_bit, monitor);
}

// A missing point inside a volume gets the widest segment across the axis through it; walls over and under
// that segment then put the point on their boundary.
void erect_for_point(const Polyhedron& a, VertexId vertex, std::size_t axis, WallBuilder& builder, Mesh& walls,
                     const Monitor& monitor) {
  const Rational3 p = a.complex().points.rational(point_of(vertex));
  Rational3 way;
  way[(axis + 1) % 3] = 1;
  const std::optional<RayHit> right = shoot_ray(a, p, way, {}, monitor);
  way[(axis + 1) % 3] = -1;
  const std::optional<RayHit> left = shoot_ray(a, p, way, {}, monitor);
  NEF_ASSERT(left && right);  // the volume is bounded
  builder.erect(left->point, right->point, walls);
}

// One wall for each vertical reflex edge. Walls in one plane are often one wall (a cross of two beams
// has four such edges and needs two walls), so the plane that serves most edges of a volume is taken first.
void erect_cross_walls(const std::vector<ReflexEdge>& edges, WallBuilder& builder, Mesh& walls) {
  using Key = std::array<std::uint32_t, 2>;  // volume, row of the plane
  const auto key = [&](std::uint32_t e, std::size_t k) {
    const PlaneId plane = edges[e].cross_wall[k].plane;
    return Key{edges[e].volume.index(), plane.valid() ? plane.row() : PlaneId::kNone};
  };
  std::map<Key, std::vector<std::uint32_t>> users;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    for (std::size_t k = 0; k < 2; ++k) users[key(e, k)].push_back(e);
  }
  std::map<Key, std::size_t> votes;
  std::set<std::pair<std::size_t, Key>, std::greater<>> order;
  for (const auto& [plane, list] : users) {
    votes[plane] = list.size();
    order.emplace(list.size(), plane);
  }
  std::vector<std::uint8_t> done(edges.size(), 0);
  while (!order.empty()) {
    const Key best = order.begin()->second;
    order.erase(order.begin());
    for (const std::uint32_t e : users[best]) {
      if (done[e] != 0) continue;
      done[e] = 1;
      const std::size_t k = key(e, 0) == best ? 0 : 1;
      builder.erect(edges[e], edges[e].cross_wall[k], walls);
      const Key other = key(e, 1 - k);
      if (order.erase({votes[other], other}) > 0) order.emplace(--votes[other], other);
    }
  }
}

// The walls of one phase; none if every selected volume is convex.
Mesh next_walls(const Polyhedron& a, std::size_t axis, const Monitor& monitor) {
  const std::vector<ReflexEdge> edges = reflex_edges(a.complex(), axis, monitor);
  const std::vector<VertexId> points = lonely_vertices(a.complex());
  Mesh walls;
  if (edges.empty() && points.empty()) return walls;
  WallBuilder builder(a.complex(), axis, monitor);
  for (const VertexId v : points) erect_for_point(a, v, axis, builder, walls, monitor);
  for (const ReflexEdge& e : edges) {
    if (!e.vertical) builder.erect(e, walls);
  }
  if (walls.face_count() == 0) erect_cross_walls(edges, builder, walls);
  return walls;
}

// Where a ray inside a facet leaves it: the nearest point of the facet's boundary.
class FacetRays {
 public:
  FacetRays(const Complex& complex, FacetId facet) : facet_(complex.facets[facet]) {
    while (complex.planes.coefficient(facet_.plane, drop_).sign() == 0) ++drop_;
    for (const SHalfedgeId c : complex.corners_of(facet_)) {
      edges_.push_back({complex.points.rational(point_of(complex.shalfedge_vertex(c))),
                        complex.points.rational(point_of(complex.target(complex.corner_halfedge(c))))});
    }
  }

  [[nodiscard]] Rational3 first_hit(const Rational3& p, const Rational3& g) const {
    std::optional<Rational> nearest;
    const auto consider = [&](const Rational& t) {
      if (t > 0 && (!nearest || t < *nearest)) nearest = t;
    };
    for (const auto& [a, b] : edges_) {
      const Rational sa = turn(g, p, a);
      const Rational sb = turn(g, p, b);
      if (sgn(sa) == 0) consider(along(g, p, a));
      if (sgn(sa) * sgn(sb) < 0) {
        const Rational s = sa / (sa - sb);
        consider(along(g, p, a) * (1 - s) + along(g, p, b) * s);
      }
    }
    NEF_ASSERT(nearest.has_value());  // facets of a bounded set are bounded
    return {Rational(p[0] + *nearest * g[0]), Rational(p[1] + *nearest * g[1]), Rational(p[2] + *nearest * g[2])};
  }

 private:
  [[nodiscard]] Rational turn(const Rational3& g, const Rational3& p, const Rational3& q) const {
    const std::size_t i = (drop_ + 1) % 3;
    const std::size_t j = (drop_ + 2) % 3;
    return g[i] * (q[j] - p[j]) - g[j] * (q[i] - p[i]);
  }
  [[nodiscard]] Rational along(const Rational3& g, const Rational3& p, const Rational3& q) const {
    Rational top = 0;
    Rational bottom = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      top += g[i] * (q[i] - p[i]);
      bottom += g[i] * g[i];
    }
    return top / bottom;
  }

  Facet facet_;
  std::size_t drop_ = 0;
  std::vector<std::array<Rational3, 2>> edges_;
};

}  // namespace

Polyhedron erect_walls(const Polyhedron& a, std::size_t axis, const Monitor& monitor) {
  Polyhedron result = a;
  // Two phases do for what has no missing points; the walls of a phase may meet those of another
  // kind at points that were missing, hence some slack. Each round removes reflex edges for good.
  for (int round = 0; round < 8; ++round) {
    const Mesh walls = next_walls(result, axis, monitor);
    if (walls.face_count() == 0) return result;
    result = insert(
        result, from_mesh(walls, MeshOptions{.strict = true, .as_surface = true, .check = false, .monitor = monitor}),
        kWall, monitor);
  }
  NEF_ASSERT(next_walls(result, axis, monitor).face_count() == 0);
  return result;
}

Polyhedron cut_facets(const Polyhedron& a, std::span<const FacetId> facets, const Monitor& monitor) {
  const Complex& complex = a.complex();
  std::vector<Polyhedron> cuts;
  for (const FacetId f : facets) {
    const FacetRays rays(complex, f);
    const Integer3 d = cut_direction(complex, complex.facets[f].plane).integers();
    for (const ReflexCorner& corner : reflex_corners(complex, f, monitor)) {
      const Rational3 p = complex.points.rational(point_of(corner.vertex));
      for (std::size_t k = 0; k < 2; ++k) {
        if (!corner.inside[k]) continue;
        const int way = k == 0 ? -1 : 1;
        const Rational3 g = {Rational(way * d[0]), Rational(way * d[1]), Rational(way * d[2])};
        cuts.push_back(make_segment(p, rays.first_hit(p, g), monitor));
      }
    }
  }
  return insert(a, unite_all(cuts, monitor), kCut, monitor);
}

}  // namespace nef::minkowski
