// SPDX-License-Identifier: Apache-2.0
//
// 1. Volumes are sorted into selected (bounded), unselected, and those that no mesh holds. The boundary is the facets
// between a selected volume and any other. 2. The vertices of these facets get numbers, in their order. Where these are
// all that there are, as in most sets, no numbers are made. 3. A triangle is written as it is. Other facets are kept as
// polygons if the options allow it, and triangulated if not; vertices inside a facet become holes of one point, so that
// triangles end there. 4. All items are looked at for what the mesh does not say of the set. A vertex with the same
// pattern that sees the same volumes as the last one has the same losses, which makes this a few comparisons a vertex.
#include "nef/export/to_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "nef/base/error.h"
#include "nef/export/mesh_losses.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/number/nearest_quotient.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

constexpr std::uint32_t kUnused = 0xffffffffU;

class Exporter {
 public:
  Exporter(const Complex& complex, const MeshExportOptions& options, const Monitor& monitor)
      : complex_(complex), options_(options), monitor_(monitor), volumes_(complex.volume_count()) {}

  MeshExport exact() {
    choose_vertices();
    std::vector<std::array<double, 3>> doubles;
    doubles.reserve(places_.size());
    for (const PointId p : places_) doubles.push_back(complex_.points.approximate(p));
    write(doubles);
    faces_.vertices.reserve(places_.size());
    for (const PointId p : places_) faces_.vertices.push_back(complex_.points.rational(p));
    MeshExport result;
    result.mesh = std::move(faces_);
    result.closed = !lower_dimensional_;
    for (const auto& [v, w] : lines_) result.lines.push_back({number(v), number(w)});
    for (const VertexId v : points_) result.points.push_back(number(v));
    result.lost = losses_.lines();
    result.face_marks = std::move(face_marks_);
    return result;
  }

  RoundedMeshExport rounded() {
    choose_vertices();
    RoundedMeshExport result;
    result.mesh.vertices = nearest_to_places();
    write(result.mesh.vertices);
    result.mesh.face_begin = std::move(faces_.face_begin);
    result.mesh.corners = std::move(faces_.corners);
    result.lost = losses_.lines();
    return result;
  }

 private:
  // What facets of one mark between the same volumes are.
  struct FacetKind {
    bool is_boundary = false;
    bool is_below = false;  // the solid lies above
  };

  [[nodiscard]] bool is_selected(LabelId mark) const {
    if (mark == kOutside) return false;
    return options_.selected ? options_.selected(mark) : mark != 0;
  }
  [[nodiscard]] bool finite(VertexId vertex) const {
    return !complex_.has_box() || complex_.points.finite(point_of(vertex));
  }

  // Chooses and numbers what the mesh has, up to its faces.
  void choose_vertices() {
    classify_volumes();
    collect_facets();
    if (boundary_.empty() && options_.lower_dimensional) collect_lower_dimensional();
    number_vertices();
  }

  // `doubles`: near the vertices of the mesh.
  void write(std::span<const std::array<double, 3>> doubles) {
    write_facets(doubles);
    look_for_losses();
    if (lower_dimensional_) count_open_borders();
  }

  [[nodiscard]] std::vector<std::array<double, 3>> nearest_to_places() const {
    std::vector<std::array<double, 3>> doubles;
    doubles.reserve(places_.size());
    const PointTable& points = complex_.points;
    const bool all_are_nearest = points.all_are_nearest();  // of those that are finite, as these are
    for (const PointId p : places_) {
      doubles.push_back(all_are_nearest ? points.approximate(p) : nearest_doubles(points, p));
    }
    return doubles;
  }

  // A selected volume is unbounded if it is the outer one, or has a facet on an infimaximal box.
  void classify_volumes() {
    IndexedVector<VolumeId, bool> unbounded(volumes_.size(), false);
    if (!unbounded.empty()) unbounded[kOuterVolume] = true;
    if (complex_.has_box()) {
      for (const Facet& facet : complex_.facets) {
        if (!complex_.planes.infimaximal(facet.plane)) continue;
        unbounded[facet.volume_above] = true;
        unbounded[facet.volume_below] = true;
      }
    }
    for (const VolumeId v : volumes_.ids()) {
      const LabelId mark = complex_.volumes[v].mark;
      if (mark == kOutside) {
        volumes_[v].other = true;
      } else if (!is_selected(mark)) {
        volumes_[v].unselected = true;
      } else if (unbounded[v]) {
        volumes_[v].other = true;
        ++losses_.volumes;
      } else {
        volumes_[v].selected = true;
      }
    }
  }

  void collect_facets() {
    for (const FacetSides& sides : complex_.facets.kinds()) {
      const bool above = volumes_[sides.volume_above].selected;
      kinds_.push_back({above != volumes_[sides.volume_below].selected, above});
    }
    boundary_.reserve(complex_.facet_count());
    for (const FacetId f : complex_.facets.ids()) {
      if (kinds_[complex_.facets.kind(f)].is_boundary) boundary_.push_back(f);
    }
  }

  // Of a set without solid parts: facets, edges outside of these, and vertices outside of all these.
  void collect_lower_dimensional() {
    IndexedVector<VertexId, bool> held(complex_.vertex_count(), false);
    IndexedVector<HalfedgeId, bool> in_facet(complex_.svertex_count(), false);
    for (const FacetId f : complex_.facets.ids()) {
      const Facet& facet = complex_.facets[f];
      if (!is_selected(facet.mark) || sees_other(facet)) continue;
      boundary_.push_back(f);
      for (const SHalfedgeId corner : complex_.corners_of(facet)) {
        const HalfedgeId h = complex_.corner_halfedge(corner);
        in_facet[h] = in_facet[complex_.twin[h]] = true;
        held[complex_.shalfedge_vertex(corner)] = true;
      }
      for (const VertexId v : complex_.isolated_vertices_of(facet)) {
        held[v] = true;
      }
    }
    for (const HalfedgeId h : complex_.halfedge_ids()) {
      const VertexId v = complex_.source(h);
      const VertexId w = complex_.target(h);
      if (in_facet[h] || h > complex_.twin[h] || !is_selected(complex_.svertex(h).mark)) continue;
      if (!finite(v) || !finite(w) || sides_of_edge(v, h).selected) continue;
      lines_.push_back({v, w});
      held[v] = held[w] = true;
    }
    for (const VertexId v : complex_.vertex_ids()) {
      if (!held[v] && finite(v) && is_selected(complex_.mark(v))) points_.push_back(v);
    }
    lower_dimensional_ = !boundary_.empty() || !lines_.empty() || !points_.empty();
  }

  // A volume on a side of the facet is lost as a whole.
  [[nodiscard]] bool sees_other(const Facet& facet) const {
    if (volumes_[facet.volume_above].other || volumes_[facet.volume_below].other) return true;
    for (const SHalfedgeId corner : complex_.corners_of(facet)) {
      if (!finite(complex_.shalfedge_vertex(corner))) return true;
    }
    return false;
  }

  [[nodiscard]] bool has_all_facets() const { return boundary_.size() == complex_.facet_count(); }

  // Every vertex with an arc is a corner of a facet, as each arc is one corner.
  [[nodiscard]] bool has_all_vertices() const {
    if (!has_all_facets() || 2 * complex_.corners.size() != complex_.shalfedge_count()) return false;
    for (std::uint32_t i = 0; i < complex_.patterns.size(); ++i) {
      if (complex_.patterns.shalfedges(PatternId{i}).empty()) return false;
    }
    return true;
  }

  // Vertices keep their order; only those of the boundary get a number.
  void number_vertices() {
    if (has_all_vertices()) {
      places_.reserve(complex_.vertex_count());
      for (const VertexId v : complex_.vertex_ids()) places_.push_back(point_of(v));
      return;
    }
    number_.assign(complex_.vertex_count(), kUnused);
    for (const auto& [v, w] : lines_) number_[v] = number_[w] = 0;
    for (const VertexId v : points_) number_[v] = 0;
    for (const FacetId f : boundary_) {
      for (const SHalfedgeId corner : complex_.corners_of(f)) number_[complex_.shalfedge_vertex(corner)] = 0;
    }
    for (const VertexId v : number_.ids()) {
      if (number_[v] == kUnused) continue;
      NEF_ASSERT(finite(v));
      number_[v] = static_cast<std::uint32_t>(places_.size());
      places_.push_back(point_of(v));
    }
  }

  // Or kUnused.
  [[nodiscard]] std::uint32_t number(VertexId v) const { return number_.empty() ? v.index() : number_[v]; }
  [[nodiscard]] std::uint32_t number(SHalfedgeId corner) const { return number(complex_.shalfedge_vertex(corner)); }

  void count_corners() {
    const bool has_points = !complex_.isolated_vertices.empty();
    for (const FacetId f : boundary_) {
      const Facet facet = complex_.facets[f];
      const std::size_t corners = complex_.corners_of(facet).size();
      corner_count_ += corners;
      cycle_count_ += facet.cycle_count;
      if (corners != 3 || (has_points && facet.isolated_count != 0)) polygon_corners_ += corners;
    }
  }

  void collect_rings(const Facet& facet) {
    const std::span<const SHalfedgeId> corners = complex_.corners_of(facet);
    rings_.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) rings_[i] = number(corners[i]);
    ring_end_.clear();
    for (const CycleId cycle : facet.cycles()) {
      ring_end_.push_back(complex_.cycle_begin[cycle.next()] - complex_.cycle_begin[facet.first_cycle]);
    }
    // Where another part of the boundary touches the facet in a point, triangles end, too.
    for (const VertexId v : complex_.isolated_vertices_of(facet)) {
      if (number(v) == kUnused) continue;
      rings_.push_back(number(v));
      ring_end_.push_back(static_cast<std::uint32_t>(rings_.size()));
    }
  }

  // A ring that meets itself is no polygon for most readers.
  bool may_stay_polygon(const std::vector<std::uint32_t>& ring) {
    if (options_.polygon_corner) {
      passes_.resize(places_.size(), Answer::kUnknown);
      for (const std::uint32_t v : ring) {
        if (passes_[v] == Answer::kUnknown) {
          const Rational3 corner = complex_.points.rational(places_[v]);
          passes_[v] = options_.polygon_corner(corner) ? Answer::kYes : Answer::kNo;
        }
        if (passes_[v] == Answer::kNo) return false;
      }
    }
    std::vector<std::uint32_t> sorted(ring);
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  }

  // The points that a triangulator is asked about.
  [[nodiscard]] MeshPoints points_of_polygons(std::span<const std::array<double, 3>> doubles) const {
    if (polygon_corners_ == 0) return MeshPoints(PointTable());
    std::vector<std::uint32_t> asked;  // all, unless these are much fewer
    if (polygon_corners_ < places_.size() / 2 && complex_.isolated_vertices.empty()) {
      asked.reserve(polygon_corners_);
      for (const FacetId f : boundary_) {
        const std::span<const SHalfedgeId> corners = complex_.corners_of(f);
        if (corners.size() == 3) continue;
        for (const SHalfedgeId corner : corners) asked.push_back(number(corner));
      }
    }
    return MeshPoints(complex_.points, places_, doubles, asked);
  }

  // As many as there are if none stays a polygon: a facet of n corners in c cycles with i points inside is
  // n + 2 c - 4 + 2 i triangles.
  void reserve_faces() {
    std::size_t count = corner_count_ + 2 * cycle_count_ + 2 * complex_.isolated_vertices.size();
    count -= 4 * boundary_.size();
    faces_.face_begin.resize(options_.keep_polygons ? boundary_.size() + 1 : count + 1);
    faces_.corners.resize(options_.keep_polygons ? corner_count_ : 3 * count);
    corner_count_ = 0;
  }

  void write_facets(std::span<const std::array<double, 3>> doubles) {
    count_corners();
    const MeshPoints points = points_of_polygons(doubles);
    Triangulator triangulator(points, monitor_);
    reserve_faces();
    const bool has_points = !complex_.isolated_vertices.empty();
    for (const FacetId f : boundary_) {
      // Cycles turn counterclockwise as seen from above, which is outside if the solid lies below.
      const bool flip = kinds_[complex_.facets.kind(f)].is_below;
      const std::span<const SHalfedgeId> corners = complex_.corners_of(f);
      if (options_.face_marks) note_marks(complex_.facets[f], flip);
      // The outer cycle has three corners at least.
      if (corners.size() == 3 && !(has_points && complex_.facets[f].isolated_count != 0)) {
        push_triangle({number(corners[0]), number(corners[1]), number(corners[2])}, flip);
      } else {
        write_polygon(complex_.facets[f], flip, triangulator);
      }
    }
    if (options_.face_marks) fill_marks();
    faces_.face_begin.resize(face_count_ + 1);
    faces_.corners.resize(corner_count_);
  }

  // Kept, or in triangles.
  void write_polygon(const Facet& facet, bool flip, Triangulator& triangulator) {
    collect_rings(facet);
    const ProjectionAxis projection = projection_axis(complex_.planes, facet.plane);
    if (options_.keep_polygons && ring_end_.size() == 1 &&
        (!options_.only_quads || (rings_.size() <= 4 && triangulator.is_convex(rings_, projection.axis))) &&
        may_stay_polygon(rings_)) {
      if (flip) std::reverse(rings_.begin(), rings_.end());
      std::ranges::copy(rings_, room_for_faces(1, rings_.size()));
      end_face(rings_.size());
      return;
    }
    triangles_.clear();
    const bool done = triangulator.triangulate(rings_, ring_end_, projection.axis, projection.sign, triangles_);
    NEF_ASSERT(done);
    push_triangles(triangles_, flip);
  }

  // Of the faces since the last facet, and then of this one's first.
  void note_marks(const Facet& facet, bool flip) {
    fill_marks();
    std::array<LabelId, 3> marks{complex_.volumes[facet.volume_below].mark, complex_.volumes[facet.volume_above].mark,
                                 facet.mark};
    if (flip) std::swap(marks[0], marks[1]);
    face_marks_.push_back(marks);
  }
  // A facet may be many faces.
  void fill_marks() {
    if (!face_marks_.empty()) face_marks_.resize(face_count_, face_marks_.back());
  }

  // The corners begin where they would if the face were kept as a polygon, or were triangulated.
  void push_triangle(const std::array<std::uint32_t, 3>& v, bool flip) {
    const bool turned = flip || !options_.keep_polygons;
    std::uint32_t* const to = room_for_faces(1, 3);
    to[0] = turned ? v[2] : v[0];
    to[1] = turned && !flip ? v[0] : v[1];
    to[2] = flip ? v[0] : turned ? v[1] : v[2];
    end_face(3);
  }

  void push_triangles(std::span<const Triangulator::Triangle> triangles, bool flip) {
    std::uint32_t* to = room_for_faces(triangles.size(), 3 * triangles.size());
    for (const Triangulator::Triangle& t : triangles) {
      *to++ = t[0];
      *to++ = t[flip ? 2 : 1];
      *to++ = t[flip ? 1 : 2];
      end_face(3);
    }
  }

  // Where the next face begins. The arrays are as large as the faces can become, and cut to size at the end: growing
  // vectors corner by corner took half of the time of a mesh of triangles.
  std::uint32_t* room_for_faces(std::size_t faces, std::size_t corners) {
    if (face_count_ + faces >= faces_.face_begin.size()) faces_.face_begin.resize(2 * (face_count_ + faces));
    if (corner_count_ + corners > faces_.corners.size()) faces_.corners.resize(2 * (corner_count_ + corners));
    return faces_.corners.data() + corner_count_;
  }

  void end_face(std::size_t corners) {
    corner_count_ += corners;
    faces_.face_begin[++face_count_] = static_cast<std::uint32_t>(corner_count_);
  }

  // Sorts items by what their mark and the volumes around them say about the mesh.
  void judge(const SeenVolumes& sides, LabelId mark, std::size_t ItemCounts::*member, std::size_t count,
             MeshLosses& to) const {
    const bool selected = is_selected(mark);
    if (sides.selected && !selected) {
      ItemCounts& items = sides.unselected || sides.other ? to.open : to.cracks;
      items.*member += count;
    }
    if (!sides.selected && !sides.other && selected && !lower_dimensional_) to.flat.*member += count;
  }

  // Few sets have facets that are lost.
  void look_for_lost_facets() {
    const std::span<const FacetSides> kinds = complex_.facets.kinds();
    std::vector<MeshLosses> of_kind(kinds.size());
    bool any = false;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      SeenVolumes sides = volumes_[kinds[i].volume_above];
      sides.add(volumes_[kinds[i].volume_below]);
      judge(sides, kinds[i].mark, &ItemCounts::facets, 1, of_kind[i]);
      any = any || of_kind[i].flat.any() || of_kind[i].open.any() || of_kind[i].cracks.any();
    }
    if (!any) return;
    for (const FacetId f : complex_.facets.ids()) losses_ += of_kind[complex_.facets.kind(f)];
  }

  void look_for_losses() {
    look_for_lost_facets();
    // Then whatever lies in the closure of a facet sees a volume of the mesh, and is lost only if it is not selected.
    const bool all_facets = has_all_facets() && !lower_dimensional_;
    const std::vector<bool> keeps_all = all_facets ? whole_patterns() : std::vector<bool>(complex_.patterns.size());
    if (std::find(keeps_all.begin(), keeps_all.end(), false) == keeps_all.end()) return;
    // What a vertex and the ends of edges there add is the same for those that have a pattern and see the same volumes.
    struct Known {
      std::vector<SeenVolumes> seen;  // by each sface
      MeshLosses losses;
    };
    std::vector<Known> known(complex_.patterns.size());
    std::vector<SeenVolumes> seen;
    MeshLosses ends;
    for (const VertexId v : complex_.vertex_ids()) {
      const std::uint32_t pattern = complex_.vertices.pattern(v).index();
      if (keeps_all[pattern] || !finite(v)) continue;
      seen.clear();
      for (const SFaceId s : complex_.sfaces(v)) seen.push_back(volumes_[complex_.sface_volume(s)]);
      Known& here = known[pattern];
      // With a box, the other ends of edges matter, too.
      if (complex_.has_box() || here.seen != seen) here = {seen, losses_at(v, seen, all_facets)};
      ends += here.losses;
    }
    for (ItemCounts* items : {&ends.flat, &ends.open, &ends.cracks}) items->edges /= 2;
    losses_ += ends;
  }

  // Of a vertex and its edges, which count once for each end. `seen`: by each of its sfaces.
  [[nodiscard]] MeshLosses losses_at(VertexId v, const std::vector<SeenVolumes>& seen, bool all_facets) const {
    MeshLosses losses;
    const SphereMapView map = complex_.sphere_map(v);
    const bool at_facet = all_facets && !(map.shalfedges.empty() && map.sloops.empty());
    if (!at_facet || !is_selected(map.mark)) {
      SeenVolumes sides;
      for (const SeenVolumes& volume : seen) sides.add(volume);
      judge(sides, map.mark, &ItemCounts::vertices, 1, losses);
    }
    for (const HalfedgeId h : complex_.halfedges(v)) {
      const SVertex& svertex = complex_.svertex(h);
      if (all_facets && svertex.out != kNone && is_selected(svertex.mark)) continue;
      judge(sides_of_edge(v, h), svertex.mark, &ItemCounts::edges, finite(complex_.target(h)) ? 1 : 2, losses);
    }
    return losses;
  }

  // Of each pattern: its vertices and all their edges are selected, and lie in facets.
  [[nodiscard]] std::vector<bool> whole_patterns() const {
    std::vector<bool> result;
    for (std::uint32_t i = 0; i < complex_.patterns.size(); ++i) {
      const SphereMapView map = complex_.patterns.view(PatternId{i});
      const auto is_whole = [&](const SVertex& s) { return s.out != kNone && is_selected(s.mark); };
      result.push_back(!map.shalfedges.empty() && is_selected(map.mark) &&
                       std::all_of(map.svertices.begin(), map.svertices.end(), is_whole));
    }
    return result;
  }

  [[nodiscard]] SeenVolumes sides_of_edge(VertexId vertex, HalfedgeId halfedge) const {
    const SphereMapView map = complex_.sphere_map(vertex);
    const VertexRecord& record = complex_.vertices[vertex];
    const SVertex& svertex = complex_.svertex(halfedge);
    if (svertex.out == kNone) return volumes_[complex_.sface_volume(record.sfaces + svertex.sface)];
    SeenVolumes sides;
    std::uint32_t e = svertex.out;
    do {
      sides.add(volumes_[complex_.sface_volume(record.sfaces + map.shalfedges[e].sface)]);
      e = map.next_around(e);
    } while (e != svertex.out);
    return sides;
  }

  // Edges and vertices of the facets that are written and do not belong to the set.
  void count_open_borders() {
    IndexedVector<HalfedgeId, bool> seen_edge(complex_.svertex_count(), false);
    IndexedVector<VertexId, bool> seen_vertex(complex_.vertex_count(), false);
    for (const FacetId f : boundary_) {
      for (const SHalfedgeId corner : complex_.corners_of(f)) {
        const VertexId v = complex_.shalfedge_vertex(corner);
        const HalfedgeId h = complex_.corner_halfedge(corner);
        if (!seen_vertex[v] && !is_selected(complex_.mark(v))) ++losses_.open.vertices;
        if (!seen_edge[h] && !is_selected(complex_.svertex(h).mark)) ++losses_.open.edges;
        seen_vertex[v] = true;
        seen_edge[h] = seen_edge[complex_.twin[h]] = true;
      }
    }
  }

  enum class Answer : std::uint8_t { kUnknown, kYes, kNo };

  const Complex& complex_;
  const MeshExportOptions& options_;
  Monitor monitor_;
  IndexedVector<VolumeId, SeenVolumes> volumes_;
  std::vector<FacetId> boundary_;
  std::vector<FacetKind> kinds_;
  std::size_t cycle_count_ = 0;                    // of facets of the boundary
  std::size_t polygon_corners_ = 0;                // those of facets that are no triangles
  IndexedVector<VertexId, std::uint32_t> number_;  // in the mesh, of each vertex; empty: their own
  std::vector<Answer> passes_;                     // of each vertex of the mesh: may it be a corner of a polygon?
  std::vector<std::array<VertexId, 2>> lines_;     // of the complex
  std::vector<VertexId> points_;
  bool lower_dimensional_ = false;
  MeshLosses losses_;
  std::vector<std::uint32_t> rings_;               // of one facet, of vertices of the mesh
  std::vector<std::uint32_t> ring_end_;            // and where in these each ring ends
  std::vector<Triangulator::Triangle> triangles_;  // of one facet
  std::vector<PointId> places_;                    // of each vertex of the mesh
  Mesh faces_;                                     // its vertices come last
  std::size_t face_count_ = 0;                     // of faces_, whose arrays are longer until all are there
  std::size_t corner_count_ = 0;                   // likewise
  std::vector<std::array<LabelId, 3>> face_marks_;
};

}  // namespace

std::array<double, 3> nearest_doubles(const PointTable& points, PointId point) {
  if (points.is_nearest(point)) return points.approximate(point);
  const std::array<IntegerView, 4> h = points.coordinates(point);
  return {nearest_quotient(h[0], h[3]), nearest_quotient(h[1], h[3]), nearest_quotient(h[2], h[3])};
}

RoundedMeshExport to_rounded_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options,
                                  const Monitor& monitor) {
  return Exporter(polyhedron.complex(), options, monitor).rounded();
}

MeshExport to_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options, const Monitor& monitor) {
  return Exporter(polyhedron.complex(), options, monitor).exact();
}

}  // namespace nef
