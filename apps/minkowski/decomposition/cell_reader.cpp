// SPDX-License-Identifier: Apache-2.0
//
// For each selected volume, the facets, edges and vertices of its boundary are gathered. Facets in one plane form one
// face of the cell; its corners are the vertices at which three planes of the volume meet. Marks belong to the faces of
// the cell rather than to the items: each item is named by the set of faces that contain it (one for a facet, two for
// an edge, more for a vertex), and a face belongs to the cell if all items with its name are selected and all larger
// faces belong, too. These are visited by the size of the name. What is selected and in no solid cell becomes polygons,
// segments and points.
#include "apps/minkowski/decomposition/cell_reader.h"

#include <algorithm>
#include <iterator>

#include "apps/minkowski/decomposition/reflex.h"
#include "apps/minkowski/decomposition/walls.h"
#include "nef/base/error.h"
#include "nef/construct/planar_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {
namespace {

using Faces = std::vector<std::uint32_t>;  // sorted

Faces common(const Faces& a, const Faces& b) {
  Faces result;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

// The face of a convex cell that holds an item is told by the set of facets through it: one for
// the inside of a facet, two for the inside of an edge, more for a vertex.
struct CellReader::Carriers {
  std::vector<Faces> of_facet, of_halfedge, of_vertex;
};

CellReader::CellReader(const Complex& complex, const Monitor& monitor)
    : complex_(complex),
      monitor_(monitor),
      facets_of_volume_(complex.volume_count()),
      facet_taken_(complex.facet_count(), 0),
      halfedge_taken_(complex.svertex_count(), 0),
      vertex_taken_(complex.vertex_count(), 0),
      seen_halfedge_(complex.svertex_count(), 0),
      seen_vertex_(complex.vertex_count(), 0),
      local_(complex.vertex_count(), 0) {
  for (const FacetId f : complex.facets.ids()) {
    const Facet& facet = complex.facets[f];
    facets_of_volume_[facet.volume_above].push_back(f);
    // A facet with the same volume on both sides cannot bound a convex one.
    if (facet.volume_below != facet.volume_above) facets_of_volume_[facet.volume_below].push_back(f);
  }
}

bool CellReader::selected(LabelId label) const { return (label & kSelected) != 0 && label != kOutside; }

void CellReader::collect_items(VolumeId volume) {
  ++turn_;
  volume_ = volume;
  facets_ = facets_of_volume_[volume];
  halfedges_.clear();
  vertices_.clear();
  const auto add_vertex = [&](VertexId v) {
    if (seen_vertex_[v] == turn_) return;
    seen_vertex_[v] = turn_;
    local_[v] = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(v);
  };
  for (const FacetId f : facets_) {
    const Facet& facet = complex_.facets[f];
    for (const SHalfedgeId c : complex_.corners_of(facet)) {
      add_vertex(complex_.shalfedge_vertex(c));
      const HalfedgeId forth = complex_.corner_halfedge(c);
      const HalfedgeId h = complex_.edge(forth);
      if (seen_halfedge_[h] == turn_) continue;
      seen_halfedge_[h] = turn_;
      halfedges_.push_back(h);
    }
    for (const VertexId v : complex_.isolated_vertices_of(facet)) add_vertex(v);
  }
}

void CellReader::take_all() {
  for (const FacetId f : facets_) facet_taken_[f] = 1;
  for (const HalfedgeId h : halfedges_) halfedge_taken_[h] = 1;
  for (const VertexId v : vertices_) vertex_taken_[v] = 1;
}

CellReader::Carriers CellReader::carriers(const ConvexCell& cell) const {
  Carriers result;
  std::vector<Rational3> normals;
  std::vector<Rational3> origins;
  for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
    const auto face = cell.mesh.face(f);
    const Rational3& o = cell.mesh.vertices[face[0]];
    normals.push_back(cross(minus(cell.mesh.vertices[face[1]], o), minus(cell.mesh.vertices[face[2]], o)));
    origins.push_back(o);
  }
  for (const VertexId v : vertices_) {
    const Rational3 p = complex_.points.rational(point_of(v));
    Faces& faces = result.of_vertex.emplace_back();
    for (std::uint32_t f = 0; f < normals.size(); ++f) {
      if (sgn(dot(normals[f], minus(p, origins[f]))) == 0) faces.push_back(f);
    }
  }
  for (const HalfedgeId h : halfedges_) {
    result.of_halfedge.push_back(
        common(result.of_vertex[local_[complex_.source(h)]], result.of_vertex[local_[complex_.target(h)]]));
  }
  for (const FacetId f : facets_) {
    const auto corners = complex_.corners_of(f);
    Faces faces = result.of_vertex[local_[complex_.shalfedge_vertex(corners[0])]];
    for (const SHalfedgeId c : corners) faces = common(faces, result.of_vertex[local_[complex_.shalfedge_vertex(c)]]);
    NEF_ASSERT(faces.size() == 1);
    result.of_facet.push_back(std::move(faces));
  }
  return result;
}

void CellReader::set_marks(ConvexCell& cell) {
  const Carriers on = carriers(cell);
  // A face belongs to the cell if everything inside it is selected and all larger faces belong.
  // Keys are sets of facets; those of larger faces are subsets, so they come by size.
  std::map<Faces, bool> belongs;
  const auto require = [&](const Faces& face, LabelId label) {
    const auto [it, is_new] = belongs.try_emplace(face, true);
    it->second = it->second && selected(label);
  };
  for (std::size_t k = 0; k < facets_.size(); ++k) require(on.of_facet[k], complex_.facets[facets_[k]].mark);
  for (std::size_t k = 0; k < halfedges_.size(); ++k) {
    require(on.of_halfedge[k], complex_.svertex(halfedges_[k]).mark);
  }
  for (std::size_t k = 0; k < vertices_.size(); ++k) require(on.of_vertex[k], complex_.mark(vertices_[k]));
  for (std::size_t size = 2; size <= 3; ++size) {
    for (auto& [face, marked] : belongs) {
      if (std::min<std::size_t>(face.size(), 3) != size) continue;
      for (const auto& [larger, larger_marked] : belongs) {
        if (larger.size() >= size || larger_marked) continue;
        if (std::includes(face.begin(), face.end(), larger.begin(), larger.end())) marked = false;
      }
    }
  }

  std::map<Rational3, std::uint32_t> at;
  for (std::uint32_t k = 0; k < vertices_.size(); ++k) at.emplace(complex_.points.rational(point_of(vertices_[k])), k);
  std::vector<const Faces*> faces_of_corner;
  for (const Rational3& p : cell.mesh.vertices) faces_of_corner.push_back(&on.of_vertex[at.at(p)]);

  cell.boundary = ConvexCell::Boundary::kMixed;
  for (const Faces* faces : faces_of_corner) cell.vertex_marks.push_back(belongs.at(*faces) ? 1 : 0);
  for (std::uint32_t f = 0; f < cell.mesh.face_count(); ++f) {
    cell.facet_marks.push_back(belongs.at({f}) ? 1 : 0);
    const auto face = cell.mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Faces edge = common(*faces_of_corner[face[k]], *faces_of_corner[face[(k + 1) % face.size()]]);
      cell.edge_marks.push_back(belongs.at(edge) ? 1 : 0);
    }
  }
  for (std::size_t k = 0; k < facets_.size(); ++k) facet_taken_[facets_[k]] |= belongs.at(on.of_facet[k]) ? 1 : 0;
  for (std::size_t k = 0; k < halfedges_.size(); ++k) {
    halfedge_taken_[halfedges_[k]] |= belongs.at(on.of_halfedge[k]) ? 1 : 0;
  }
  for (std::size_t k = 0; k < vertices_.size(); ++k) vertex_taken_[vertices_[k]] |= belongs.at(on.of_vertex[k]) ? 1 : 0;
}

// No coordinate is compared. The facets of a convex volume in one plane make up one of its faces; a
// vertex is extreme iff it lies in three such planes. The boundary of a face is what edges of its
// facets remain when those inside the face, which occur in both directions, have cancelled out.
CellBody CellReader::body() {
  std::vector<FacetId> by_plane(facets_);
  const auto row = [&](FacetId f) { return complex_.facets[f].plane.row(); };
  std::sort(by_plane.begin(), by_plane.end(),
            [&](FacetId f, FacetId g) { return row(f) != row(g) ? row(f) < row(g) : f < g; });
  count_planes(by_plane);

  CellBody body;
  for (std::size_t first = 0, last = 0; first < by_plane.size(); first = last) {
    while (last < by_plane.size() && row(by_plane[last]) == row(by_plane[first])) ++last;
    CellBody::Face& face = body.faces.emplace_back();
    std::vector<std::uint32_t>& ring = face.ring;
    for (const VertexId v : outline({by_plane.data() + first, last - first})) {
      // An edge that dangles into the face leaves its root twice in a row.
      if (planes_at_[local_[v]] >= 3 && (ring.empty() || ring.back() != v.index())) ring.push_back(v.index());
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    NEF_ASSERT(ring.size() >= 3);
    // Corners run counterclockwise about the plane's normal, which points into a volume above.
    const Facet& facet = complex_.facets[by_plane[first]];
    face.plane = facet.plane;
    if (facet.volume_above == volume_) {
      std::reverse(ring.begin(), ring.end());
      face.plane = face.plane.opposite();
    }
  }
  return body;
}

// How many planes of the volume meet at each of its vertices.
void CellReader::count_planes(std::span<const FacetId> by_plane) {
  planes_at_.assign(vertices_.size(), 0);
  std::vector<std::uint32_t> last_plane(vertices_.size(), kNone);
  for (const FacetId f : by_plane) {
    const Facet& facet = complex_.facets[f];
    const auto meet = [&](VertexId v) {
      if (last_plane[local_[v]] == facet.plane.row()) return;
      last_plane[local_[v]] = facet.plane.row();
      ++planes_at_[local_[v]];
    };
    for (const SHalfedgeId c : complex_.corners_of(facet)) meet(complex_.shalfedge_vertex(c));
    for (const VertexId v : complex_.isolated_vertices_of(facet)) meet(v);
  }
}

// The vertices around the union of some facets, all of one plane.
std::vector<VertexId> CellReader::outline(std::span<const FacetId> facets) const {
  std::vector<VertexId> ring;
  if (facets.size() == 1 && complex_.facets[facets[0]].cycle_count == 1) {
    for (const SHalfedgeId c : complex_.corners_of(facets[0])) {
      ring.push_back(complex_.shalfedge_vertex(c));
    }
    return ring;
  }
  std::map<HalfedgeId, VertexId> open;  // halfedge -> its source, if its twin has not come yet
  for (const FacetId f : facets) {
    for (const SHalfedgeId c : complex_.corners_of(f)) {
      const HalfedgeId h = complex_.corner_halfedge(c);
      if (open.erase(complex_.twin[h]) == 0) open.emplace(h, complex_.shalfedge_vertex(c));
    }
  }
  NEF_ASSERT(!open.empty());
  std::map<VertexId, VertexId> next;
  for (const auto& [h, from] : open) next.emplace(from, complex_.target(h));
  const VertexId start = next.begin()->first;
  VertexId v = start;
  do {
    ring.push_back(v);
    v = next.at(v);
  } while (v != start);
  NEF_ASSERT(ring.size() == open.size());  // convex: one simple cycle
  return ring;
}

void CellReader::set_boundary(ConvexCell& cell) {
  bool all = true;
  bool none = true;
  const auto note = [&](LabelId label) { (selected(label) ? none : all) = false; };
  for (const FacetId f : facets_) note(complex_.facets[f].mark);
  for (const HalfedgeId h : halfedges_) note(complex_.svertex(h).mark);
  for (const VertexId v : vertices_) note(complex_.mark(v));
  if (all) {
    take_all();
  } else if (none) {
    cell.boundary = ConvexCell::Boundary::kOpen;
  } else {
    set_marks(cell);
  }
}

std::vector<ConvexCell> CellReader::solids() {
  std::vector<CellBody> closed;
  std::vector<ConvexCell> others;
  for (const VolumeId v : complex_.volumes.ids()) {
    if (!selected(complex_.volumes[v].mark)) continue;
    collect_items(v);
    CellBody read = body();
    ConvexCell cell = to_cell(complex_, read);
    set_boundary(cell);
    if (cell.boundary == ConvexCell::Boundary::kClosed) {
      closed.push_back(std::move(read));
    } else {
      others.push_back(std::move(cell));
    }
  }
  std::vector<ConvexCell> cells;
  for (const CellBody& body : merged(complex_, std::move(closed), monitor_)) cells.push_back(to_cell(complex_, body));
  std::move(others.begin(), others.end(), std::back_inserter(cells));
  return cells;
}

std::vector<ConvexCell> CellReader::open_solids() {
  std::vector<CellBody> bodies;
  for (const VolumeId v : complex_.volumes.ids()) {
    if (!selected(complex_.volumes[v].mark)) continue;
    collect_items(v);
    bodies.push_back(body());
  }
  std::vector<ConvexCell> cells;
  for (const CellBody& body : merged(complex_, std::move(bodies), monitor_)) {
    cells.push_back(opened(to_cell(complex_, body)));
  }
  return cells;
}

std::vector<FacetId> CellReader::facets_to_cut() const {
  std::vector<FacetId> result;
  for (const FacetId f : complex_.facets.ids()) {
    if (facet_taken_[f] != 0 || !selected(complex_.facets[f].mark)) continue;
    if (!reflex_corners(complex_, f, monitor_).empty()) result.push_back(f);
  }
  return result;
}

// A convex facet: corners where the boundary goes straight on are inside a side.
ConvexCell CellReader::polygon(FacetId facet) {
  const Facet& f = complex_.facets[facet];
  NEF_ASSERT(f.cycle_count == 1 && f.isolated_count == 0);
  const auto corners = complex_.corners_of(f);
  const std::size_t n = corners.size();
  std::vector<std::size_t> extreme;
  for (std::size_t k = 0; k < n; ++k) {
    const SVertex& forth = complex_.svertex(complex_.corner_halfedge(corners[k]));
    const SVertex& back = complex_.svertex(complex_.corner_back_halfedge(corners[k]));
    if (orientation_on_circle(complex_.planes, f.plane, Direction::cross(complex_.planes, forth.p, forth.q),
                              Direction::cross(complex_.planes, back.p, back.q), monitor_) != 0) {
      extreme.push_back(k);
    }
  }
  const auto vertex = [&](std::size_t k) { return complex_.shalfedge_vertex(corners[k % n]); };
  const auto halfedge = [&](std::size_t k) {
    const HalfedgeId h = complex_.corner_halfedge(corners[k % n]);
    return complex_.edge(h);
  };
  ConvexCell cell;
  cell.dimension = 2;
  cell.boundary = ConvexCell::Boundary::kMixed;
  std::vector<std::uint32_t> face;
  for (std::size_t i = 0; i < extreme.size(); ++i) {
    const std::size_t first = extreme[i];
    const std::size_t last = i + 1 < extreme.size() ? extreme[i + 1] : extreme[0] + n;
    bool marked = true;
    for (std::size_t k = first; k < last; ++k) {
      marked = marked && selected(complex_.svertex(halfedge(k)).mark);
      if (k > first) marked = marked && selected(complex_.mark(vertex(k)));
    }
    for (std::size_t k = first; marked && k < last; ++k) {
      halfedge_taken_[halfedge(k)] = 1;
      if (k > first) vertex_taken_[vertex(k)] = 1;
    }
    cell.edge_marks.push_back(marked ? 1 : 0);
    cell.mesh.vertices.push_back(complex_.points.rational(point_of(vertex(first))));
    face.push_back(static_cast<std::uint32_t>(i));
  }
  cell.mesh.push_face(face);
  for (std::size_t i = 0; i < extreme.size(); ++i) {
    const VertexId v = vertex(extreme[i]);
    const std::size_t before = i > 0 ? i - 1 : extreme.size() - 1;
    const bool marked = selected(complex_.mark(v)) && cell.edge_marks[i] != 0 && cell.edge_marks[before] != 0;
    cell.vertex_marks.push_back(marked ? 1 : 0);
    if (marked) vertex_taken_[v] = 1;
  }
  return cell;
}

ConvexCell CellReader::segment(HalfedgeId halfedge) {
  ConvexCell cell;
  cell.dimension = 1;
  cell.boundary = ConvexCell::Boundary::kMixed;
  for (const VertexId v : {complex_.source(halfedge), complex_.target(halfedge)}) {
    const bool marked = selected(complex_.mark(v));
    cell.mesh.vertices.push_back(complex_.points.rational(point_of(v)));
    cell.vertex_marks.push_back(marked ? 1 : 0);
    if (marked) vertex_taken_[v] = 1;
  }
  return cell;
}

std::vector<ConvexCell> CellReader::flat_cells() {
  std::vector<ConvexCell> cells;
  for (const FacetId f : complex_.facets.ids()) {
    if (facet_taken_[f] == 0 && selected(complex_.facets[f].mark)) cells.push_back(polygon(f));
  }
  for (const HalfedgeId h : complex_.halfedge_ids()) {
    if (h > complex_.twin[h] || halfedge_taken_[h] != 0) continue;
    if (selected(complex_.svertex(h).mark)) cells.push_back(segment(h));
  }
  for (const VertexId v : complex_.vertex_ids()) {
    if (vertex_taken_[v] != 0 || !selected(complex_.mark(v))) continue;
    const SphereMapView map = complex_.sphere_map(v);
    if (map.trivial() && selected(map.sfaces[0].mark)) continue;
    ConvexCell& cell = cells.emplace_back();
    cell.mesh.vertices.push_back(complex_.points.rational(point_of(v)));
  }
  for (ConvexCell& cell : cells) {
    const auto all = [](const std::vector<std::uint8_t>& marks) {
      return std::all_of(marks.begin(), marks.end(), [](std::uint8_t m) { return m != 0; });
    };
    if (cell.boundary != ConvexCell::Boundary::kMixed || !all(cell.edge_marks) || !all(cell.vertex_marks)) continue;
    cell.boundary = ConvexCell::Boundary::kClosed;
    cell.edge_marks.clear();
    cell.vertex_marks.clear();
  }
  return cells;
}

}  // namespace nef::minkowski
