// SPDX-License-Identifier: Apache-2.0
//
// Let p, q, r be the normals of three planes, inward, and s the sign of their determinant. Where the solid is the
// intersection of the half-spaces, its edges leave in the directions
//   d_pq = s p x q,  d_qr = s q x r,  d_rp = s r x p.
// Since (a x b) x (c x a) = -det(a, b, c) a, the facets are, for s > 0, the arcs from d_rp to d_pq counterclockwise
// about p, from d_pq to d_qr about q, and from d_qr to d_rp about r; if s < 0 all run the other way. Where p and q are
// the sides of a reflex edge, the solid is (p or q) and r: d_qr and d_rp are reversed, and with them the sense of the
// arcs of p and q; the arc of r takes the long way round, so its sense changes, too.
#include "apps/visual_hull/viewing_edges/hull_complex.h"

#include <algorithm>
#include <atomic>

#include "apps/visual_hull/cones/boundary_node.h"
#include "apps/visual_hull/scene/camera_planes.h"
#include "apps/visual_hull/viewing_edges/corners.h"
#include "nef/base/threads/parallel.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef::visual_hull {
namespace {

using nef::PlaneId;

// A task: few enough for several threads to share them, many enough for what a task costs.
constexpr std::size_t kVertices = 512;
constexpr std::size_t kPlanes = 512;

constexpr std::uint32_t kRoom = 16;  // a part more than what is known to come, too little for Complex::trim

/// Rows of the edges' planes in a table.
class EdgePlanes {
 public:
  /// Of the edges that meet in the vertices.
  EdgePlanes(const HullVertices& vertices, const std::vector<ViewingEdge>& edges,
             const std::vector<const Camera*>& cameras, const nef::Monitor& monitor)
      : ids_(edges.size()) {
    const std::vector<std::uint32_t> wanted = edges_at(vertices, edges);
    std::vector<CameraPlanes> views;
    for (const Camera* camera : cameras) views.emplace_back(*camera);
    std::vector<nef::PlaneTable> tables((wanted.size() + kPlanes - 1) / kPlanes);
    const auto each = [&](std::size_t task, const auto& visit) {
      for (std::size_t i = task * kPlanes; i < std::min((task + 1) * kPlanes, wanted.size()); ++i) visit(wanted[i]);
    };
    nef::parallel_for(tables.size(), monitor, [&](std::size_t task, const nef::Monitor&) {
      each(task, [&](std::uint32_t e) {
        const auto [a, b, c, d] = views[edges[e].view].through(*edges[e].from, *edges[e].to);
        ids_[e] = tables[task].intern(a, b, c, d);
      });
    });
    table.reserve(wanted.size());
    for (std::size_t task = 0; task < tables.size(); ++task) {
      each(task, [&](std::uint32_t e) { ids_[e] = table.intern_from(tables[task], ids_[e]); });
    }
  }

  /// Positive towards the region.
  [[nodiscard]] PlaneId of(std::uint32_t edge) const { return ids_[edge]; }

  nef::PlaneTable table;

 private:
  static std::vector<std::uint32_t> edges_at(const HullVertices& vertices, const std::vector<ViewingEdge>& edges) {
    std::vector<bool> wanted(edges.size(), false);
    for (const SpotName& name : vertices.plain) {
      for (const std::uint32_t e : name) wanted[e] = true;
      // All that start at the same vertex of a silhouette.
      for (std::uint32_t e = corner_of(name, edges).value_or(UINT32_MAX); e != UINT32_MAX; e = edges[e].next_at_place) {
        wanted[e] = wanted[edges[e].previous] = true;
      }
    }
    for (const CrowdedVertex& vertex : vertices.crowded) {
      for (const std::uint32_t e : vertex.edges) wanted[e] = true;
    }
    std::vector<std::uint32_t> list;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      if (wanted[e]) list.push_back(e);
    }
    return list;
  }

  std::vector<PlaneId> ids_;
};

/// Draws plain vertices, one after the other.
class VertexWriter {
 public:
  VertexWriter(const std::vector<ViewingEdge>& edges, EdgePlanes& planes, const nef::Monitor& monitor)
      : edges_(edges), planes_(planes), monitor_(monitor), builder_(planes.table, monitor) {}

  /// False if a corner is straight, or planes share a line.
  [[nodiscard]] bool add(const SpotName& name) { return collect(name) && push_vertex(); }

  [[nodiscard]] nef::Complex take() { return builder_.take_so_far(); }

 private:
  // The corners of a vertex, and the plane across their ray.
  [[nodiscard]] bool collect(const SpotName& name) {
    corners_.clear();
    across_ = planes_.of(name[2]);
    const std::optional<std::uint32_t> first = corner_of(name, edges_);
    if (!first) {
      corners_.push_back({planes_.of(name[0]), planes_.of(name[1]), false, name[0], name[1]});
      return true;
    }
    for (const std::uint32_t e : name) {
      if (e != *first && e != edges_[*first].previous) across_ = planes_.of(e);
    }
    for (std::uint32_t e = *first; e != UINT32_MAX; e = edges_[e].next_at_place) {
      const ViewingEdge& out = edges_[e];
      const ViewingEdge& in = edges_[out.previous];
      const int turn = orientation(*in.from, *out.from, *out.to, monitor_);
      if (turn == 0) return false;
      corners_.push_back({planes_.of(out.previous), planes_.of(e), turn < 0, out.previous, e});
    }
    return true;
  }

  /// Two planes of one view (or of two, in a corner of three views), and the nodes on their lines with the third.
  struct Corner {
    PlaneId in, out;
    bool reflex = false;
    std::uint32_t in_edge = 0;
    std::uint32_t out_edge = 0;
    std::uint32_t in_node = 0;
    std::uint32_t out_node = 0;
  };

  [[nodiscard]] bool push_vertex() {
    const PlaneId r = across_;
    map_.clear();
    std::uint32_t ray = nef::kNone;
    bool turned = false;  // the same for all corners on a ray
    for (Corner& c : corners_) {
      const int s = nef::side_of_circle(planes_.table, r, nef::Direction::cross(planes_.table, c.in, c.out), monitor_);
      if (s == 0) return false;
      turned = (s > 0) == c.reflex;
      if (ray == nef::kNone) ray = s > 0 ? add_node(c.in, c.out) : add_node(c.out, c.in);
      c.out_node = turned ? add_node(r, c.out) : add_node(c.out, r);
      c.in_node = turned ? add_node(c.in, r) : add_node(r, c.in);
      if (turned) {
        add_arc(c.in, ray, c.in_node);
        add_arc(c.out, c.out_node, ray);
      } else {
        add_arc(c.in, c.in_node, ray);
        add_arc(c.out, ray, c.out_node);
      }
    }
    for (const Corner& c : corners_) {
      const std::uint32_t end = corners_.size() == 1 ? c.in_node : next_in_node(c.out_edge);
      if (turned) {
        add_arc(r, end, c.out_node);
      } else {
        add_arc(r, c.out_node, end);
      }
    }
    map_.centre = 1;
    builder_.add({corners_[0].in, corners_[0].out, r}, map_);
    return true;
  }

  // Where rings touch: the region left of an edge that leaves the vertex ends at the next edge, which arrives.
  std::uint32_t next_in_node(std::uint32_t out) const {
    std::vector<std::uint32_t> incoming;
    for (const Corner& c : corners_) incoming.push_back(c.in_edge);
    const std::uint32_t in = next_incoming(out, incoming, edges_, monitor_);
    return std::find_if(corners_.begin(), corners_.end(), [in](const Corner& c) { return c.in_edge == in; })->in_node;
  }

  std::uint32_t add_node(PlaneId p, PlaneId q) { return add_boundary_node(map_, planes_.table, p, q); }

  void add_arc(PlaneId plane, std::uint32_t source, std::uint32_t target) {
    nef::Arrangement::Arc arc;
    arc.plane = plane;
    arc.source = source;
    arc.target = target;
    arc.mark = 1;
    arc.left = 1;
    arc.right = 0;
    map_.arcs.push_back(arc);
  }

  const std::vector<ViewingEdge>& edges_;
  const EdgePlanes& planes_;
  nef::Monitor monitor_;
  nef::ComplexBuilder builder_;
  std::vector<Corner> corners_;
  PlaneId across_;
  nef::Arrangement map_;
};

void add_crowded(const std::vector<CrowdedVertex>& vertices, const std::vector<ViewingEdge>& edges,
                 const EdgePlanes& planes, nef::ComplexBuilder& builder, const nef::Monitor& monitor) {
  CrowdedPyramids pyramids(edges, planes.table, monitor, [&planes](std::uint32_t e) { return planes.of(e); });
  nef::PointTable points;
  for (const CrowdedVertex& vertex : vertices) {
    const nef::PointId point = points.push(vertex.point);
    builder.add(points, point, pyramids.at(vertex));
  }
}

// With some room for crowded vertices.
nef::VertexRecord items_of(const std::vector<nef::Complex>& parts) {
  nef::VertexRecord sum;
  for (const nef::Complex& part : parts) {
    sum.advance(part.vertices.front(), part.vertices.back());
  }
  sum.shalfedges += 2 * (pair_of(sum.shalfedges) / kRoom);
  for (std::uint32_t* count : {&sum.sloops, &sum.other_planes}) *count += *count / kRoom;
  return sum;
}

// Of coordinates.
std::size_t limbs_of(const std::vector<nef::Complex>& parts) {
  std::size_t limbs = 0;
  for (const nef::Complex& part : parts) limbs += part.points.limbs();
  return limbs;
}

}  // namespace

std::optional<nef::Polyhedron> complex_of(const HullVertices& vertices, const std::vector<ViewingEdge>& edges,
                                          const std::vector<const Camera*>& cameras, const nef::Monitor& monitor) {
  EdgePlanes planes(vertices, edges, cameras, monitor);
  const std::vector<SpotName>& names = vertices.plain;
  std::vector<nef::Complex> parts((names.size() + kVertices - 1) / kVertices);
  std::atomic<bool> good = true;
  nef::parallel_for(parts.size(), monitor, [&](std::size_t task, const nef::Monitor& own) {
    VertexWriter writer(edges, planes, own);
    for (std::size_t i = task * kVertices; i < std::min((task + 1) * kVertices, names.size()); ++i) {
      if (!writer.add(names[i])) good = false;
    }
    parts[task] = writer.take();
  });
  if (!good) return std::nullopt;
  nef::ComplexBuilder builder(planes.table, monitor);
  builder.reserve(names.size() + vertices.crowded.size(), items_of(parts), limbs_of(parts));
  for (nef::Complex& part : parts) {
    builder.copy(part);
    part = {};
  }
  add_crowded(vertices.crowded, edges, planes, builder, monitor);
  return nef::Polyhedron(builder.finish(0));
}

}  // namespace nef::visual_hull
