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
#include "nef/base/parallel.h"
#include "nef/synthesis/complex_builder.h"

namespace visual_hull {
namespace {

using nef::PlaneId;

class ComplexWriter {
 public:
  ComplexWriter(const std::vector<ViewingEdge>& edges, const std::vector<const Camera*>& cameras)
      : edges_(edges), planes_(edges.size()) {
    for (const Camera* camera : cameras) cameras_.emplace_back(*camera);
  }

  // False if a corner is straight, or planes share a line. Points are the dearest: several threads share them.
  [[nodiscard]] bool add(const std::vector<SpotName>& names, unsigned threads) {
    constexpr std::size_t kPoints = 512;  // a task
    std::vector<std::array<PlaneId, 3>> meeting;
    meeting.reserve(names.size());
    for (const SpotName& name : names) {
      if (!collect(name)) return false;
      meeting.push_back({corners_[0].in, corners_[0].out, across_});
    }
    std::vector<std::vector<nef::PointId>> ids((names.size() + kPoints - 1) / kPoints);
    std::vector<nef::PointTable> points(ids.size());
    std::atomic<bool> good = true;
    nef::parallel_for(ids.size(), threads, [&](std::size_t task) {
      for (std::size_t i = task * kPoints; i < std::min((task + 1) * kPoints, names.size()); ++i) {
        const auto& [p, q, r] = meeting[i];
        const std::optional<nef::PointId> id = points[task].push_intersection(table_, p, q, r);
        if (id) ids[task].push_back(*id);
        if (!id) good = false;
      }
    });
    for (std::size_t i = 0; i < names.size() && good; ++i) {
      good = collect(names[i]) && push_vertex(points[i / kPoints], ids[i / kPoints][i % kPoints]);
    }
    return good;
  }

  void add(const std::vector<CrowdedVertex>& vertices) {
    CrowdedPyramids pyramids(edges_, table_, [this](std::uint32_t e) { return plane(e); });
    nef::PointTable points;
    for (const CrowdedVertex& vertex : vertices) {
      const nef::PointId point = points.push(vertex.point);
      builder_.add(points, point, pyramids.at(vertex));
    }
  }

  nef::Polyhedron finish() { return nef::Polyhedron(builder_.finish(0)); }

 private:
  // The corners of a vertex, and the plane across their ray.
  [[nodiscard]] bool collect(const SpotName& name) {
    corners_.clear();
    across_ = plane(name[2]);
    const std::optional<std::uint32_t> first = corner_of(name, edges_);
    if (!first) {
      corners_.push_back({plane(name[0]), plane(name[1]), false, name[0], name[1]});
      return true;
    }
    for (const std::uint32_t e : name) {
      if (e != *first && e != edges_[*first].previous) across_ = plane(e);
    }
    for (std::uint32_t e = *first; e != UINT32_MAX; e = edges_[e].next_at_place) {
      const ViewingEdge& out = edges_[e];
      const ViewingEdge& in = edges_[out.previous];
      const int turn = orientation(*in.from, *out.from, *out.to);
      if (turn == 0) return false;
      corners_.push_back({plane(out.previous), plane(e), turn < 0, out.previous, e});
    }
    return true;
  }

  PlaneId plane(std::uint32_t edge) {
    if (!planes_[edge].valid()) {
      const ViewingEdge& e = edges_[edge];
      const auto [a, b, c, d] = cameras_[e.view].through(*e.from, *e.to);
      planes_[edge] = table_.intern(a, b, c, d);
    }
    return planes_[edge];
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

  [[nodiscard]] bool push_vertex(const nef::PointTable& points, nef::PointId point) {
    const PlaneId r = across_;
    map_.clear();
    std::uint32_t ray = nef::kNone;
    bool turned = false;  // the same for all corners on a ray
    for (Corner& c : corners_) {
      const int s = nef::side_of_circle(table_, r, nef::Direction::cross(table_, c.in, c.out));
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
    builder_.add(points, point, map_);
    return true;
  }

  // Where rings touch: the region left of an edge that leaves the vertex ends at the next edge, which arrives.
  std::uint32_t next_in_node(std::uint32_t out) const {
    std::vector<std::uint32_t> incoming;
    for (const Corner& c : corners_) incoming.push_back(c.in_edge);
    const std::uint32_t in = next_incoming(out, incoming, edges_);
    return std::find_if(corners_.begin(), corners_.end(), [in](const Corner& c) { return c.in_edge == in; })->in_node;
  }

  std::uint32_t add_node(PlaneId p, PlaneId q) { return add_boundary_node(map_, table_, p, q); }

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
  std::vector<CameraPlanes> cameras_;
  std::vector<PlaneId> planes_;
  std::vector<Corner> corners_;
  PlaneId across_;
  nef::PlaneTable table_;
  nef::ComplexBuilder builder_{table_};
  nef::Arrangement map_;
};

}  // namespace

std::optional<nef::Polyhedron> complex_of(const HullVertices& vertices, const std::vector<ViewingEdge>& edges,
                                          const std::vector<const Camera*>& cameras, unsigned threads) {
  ComplexWriter writer(edges, cameras);
  if (!writer.add(vertices.plain, threads)) return std::nullopt;
  writer.add(vertices.crowded);
  return writer.finish();
}

}  // namespace visual_hull
