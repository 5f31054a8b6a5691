// SPDX-License-Identifier: Apache-2.0
//
// Planes and points are made when they are asked for first, since the rounded cells answer nearly all questions. To
// locate a point, faces that it is surely in front of end the search, faces that it is surely behind are passed over,
// and the others are asked exactly. A local pyramid on the boundary is that of a face, an edge or a vertex, told by the
// number of faces that hold the point.
#include "apps/minkowski/cells/exact_cells.h"

#include <algorithm>
#include <array>

#include "nef/base/error.h"

namespace nef::minkowski {
ExactCells::ExactCells(std::span<const ConvexCell> cells, const RoundedCells& rounded, const Monitor& monitor)
    : cells_(cells), rounded_(rounded), plane_(rounded.face_count()), monitor_(monitor) {
  std::size_t vertices = 0;
  for (const ConvexCell& cell : cells) vertices += cell.mesh.vertices.size();
  point_of_.assign(vertices, kNone);
}

PointId ExactCells::point(std::uint32_t cell, std::uint32_t vertex) {
  std::uint32_t& id = point_of_[rounded_.first_vertex(cell) + vertex];
  if (id == kNone) id = points.push(cells_[cell].mesh.vertices[vertex]).index();
  return PointId{id};
}

PlaneId ExactCells::plane(std::uint32_t face) {
  if (!plane_[face].valid()) {
    const std::uint32_t cell = rounded_.cell_of_face(face);
    const auto c = corners(face);
    const PointId o = point(cell, c[0]);
    const std::vector<Integer3>& normals = cells_[cell].normals;
    if (!normals.empty()) return plane_[face] = finder_.through(planes, points, normals[local(face)], o);
    const PointId p = point(cell, c[c.size() / 3]);
    const PointId q = point(cell, c[2 * c.size() / 3]);
    plane_[face] = finder_.through(planes, points, o, p, q);
  }
  return plane_[face];
}

int ExactCells::side(std::uint32_t face, std::uint32_t cell, std::uint32_t vertex) {
  const RoundedFace& rounded = rounded_.face(face);
  const double value = rounded.value(rounded_.vertices(cell)[vertex]);
  if (value > rounded.slack) return 1;
  if (value < -rounded.slack) return -1;
  ++doubtful_;
  const PlaneId p = plane(face);
  const PointId x = point(cell, vertex);
  return side_of_plane(planes, p, points, x, monitor_);
}

void ExactCells::locate(std::uint32_t cell, PointId point, CellLocation& result) {
  result.kind = CellLocation::Kind::kOutside;
  result.faces.clear();
  const Double3 x = points.approximate(point);
  const std::uint32_t first = rounded_.first_face(cell);
  const std::uint32_t last = rounded_.end_face(cell);
  for (std::uint32_t f = first; f < last; ++f) {
    const RoundedFace& face = rounded_.face(f);
    const double value = face.value(x);
    if (value > face.slack) return;
    if (!(value < -face.slack)) result.faces.push_back(f);
  }
  std::size_t kept = 0;
  for (const std::uint32_t f : result.faces) {
    ++doubtful_;
    const int s = side_of_plane(planes, plane(f), points, point, monitor_);
    if (s > 0) return;
    if (s == 0) result.faces[kept++] = f;
  }
  result.faces.resize(kept);
  result.kind = kept == 0 ? CellLocation::Kind::kInside : CellLocation::Kind::kBoundary;
}

void ExactCells::pyramid(const CellLocation& at, SphereMapBuffer& out) {
  const std::uint32_t index = rounded_.cell_of_face(at.faces[0]);
  const ConvexCell& cell = cells_[index];
  if (at.faces.size() == 1) {
    const LabelId mark = cell.facet_marked(local(at.faces[0])) ? 1 : 0;
    out.assign_circle(plane(at.faces[0]), mark, 0, 1);
    out.mark = mark;
    return;
  }
  drawing_.clear();
  if (at.faces.size() == 2) {
    draw_edge(cell, at.faces[0], at.faces[1]);
  } else {
    draw_vertex(cell, at.faces);
  }
  drawing_.sort_around_nodes(planes, monitor_);
  drawing_.simplify_and_assemble(planes, out, monitor_);
}

// Inside an edge: with f to its left, it runs along n_f x n_g, and the half circle of f goes from
// there to the opposite direction.
void ExactCells::draw_edge(const ConvexCell& cell, std::uint32_t f, std::uint32_t g) {
  const auto ring = corners(f);
  const auto other = corners(g);
  const auto in_other = [&](std::uint32_t v) { return std::find(other.begin(), other.end(), v) != other.end(); };
  LabelId mark = 1;
  if (cell.boundary != ConvexCell::Boundary::kClosed) {
    std::size_t k = 0;
    while (!in_other(ring[k]) || !in_other(ring[(k + 1) % ring.size()])) ++k;
    mark = cell.edge_marked(cell.mesh.face_begin[local(f)] + k) ? 1 : 0;
  }
  drawing_.centre = mark;
  drawing_.nodes.resize(2);
  drawing_.nodes[0].direction = Direction::cross(planes, plane(f), plane(g));
  drawing_.nodes[1].direction = Direction::cross(planes, plane(g), plane(f));
  drawing_.nodes[0].mark = drawing_.nodes[1].mark = mark;
  const auto facet_mark = [&](std::uint32_t face) -> LabelId { return cell.facet_marked(local(face)) ? 1 : 0; };
  drawing_.arcs.push_back({plane(f), 0, 1, facet_mark(f), 0, 1});
  drawing_.arcs.push_back({plane(g), 1, 0, facet_mark(g), 0, 1});
}

void ExactCells::draw_vertex(const ConvexCell& cell, std::span<const std::uint32_t> faces) {
  // The vertex that all faces have in common.
  const auto first = corners(faces[0]);
  const auto everywhere = [&](std::uint32_t v) {
    return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      const auto ring = corners(f);
      return std::find(ring.begin(), ring.end(), v) != ring.end();
    });
  };
  const auto found = std::find_if(first.begin(), first.end(), everywhere);
  NEF_ASSERT(found != first.end());
  const std::uint32_t vertex = *found;
  drawing_.centre = cell.vertex_marked(vertex) ? 1 : 0;

  struct Spoke {
    std::uint32_t to = kNone;
    PlaneId left, right;
    LabelId mark = 0;
  };
  std::vector<Spoke> spokes;
  const auto node_toward = [&](std::uint32_t w) -> std::uint32_t {
    const auto at = std::find_if(spokes.begin(), spokes.end(), [w](const Spoke& s) { return s.to == w; });
    if (at != spokes.end()) return static_cast<std::uint32_t>(at - spokes.begin());
    spokes.emplace_back().to = w;
    return static_cast<std::uint32_t>(spokes.size() - 1);
  };
  for (const std::uint32_t f : faces) {
    const auto ring = corners(f);
    const auto k = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), vertex) - ring.begin());
    const std::uint32_t source = node_toward(ring[(k + 1) % ring.size()]);
    const std::uint32_t target = node_toward(ring[(k + ring.size() - 1) % ring.size()]);
    spokes[source].left = plane(f);
    spokes[source].mark = cell.edge_marked(cell.mesh.face_begin[local(f)] + k) ? 1 : 0;
    spokes[target].right = plane(f);
    drawing_.arcs.push_back(
        {plane(f), source, target, static_cast<LabelId>(cell.facet_marked(local(f)) ? 1 : 0), 0, 1});
  }
  drawing_.nodes.resize(spokes.size());
  for (std::size_t n = 0; n < spokes.size(); ++n) {
    NEF_ASSERT(spokes[n].left.valid() && spokes[n].right.valid());
    drawing_.nodes[n].direction = Direction::cross(planes, spokes[n].left, spokes[n].right);
    drawing_.nodes[n].mark = spokes[n].mark;
  }
}

}  // namespace nef::minkowski
