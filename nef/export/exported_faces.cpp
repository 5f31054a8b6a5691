// SPDX-License-Identifier: Apache-2.0
//
// A triangle is written as it is. Other facets are kept as polygons if the options allow it, and triangulated if not;
// vertices inside a facet become holes of one point, so that triangles end there.
#include "nef/export/exported_faces.h"

#include <algorithm>
#include <utility>

#include "nef/base/error.h"
#include "nef/mesh/mesh_points.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef {
namespace {

class FaceWriter {
 public:
  FaceWriter(const ExportedParts& parts, std::span<const std::array<double, 3>> doubles,
             const MeshExportOptions& options, const Monitor& monitor)
      : parts_(parts), complex_(parts.complex()), doubles_(doubles), options_(options), monitor_(monitor) {}

  ExportedFaces write() {
    count_corners();
    const MeshPoints points = points_of_polygons();
    Triangulator triangulator(points, monitor_);
    reserve_faces();
    const bool has_points = !complex_.isolated_vertices.empty();
    for (const FacetId f : parts_.facets()) {
      // Cycles turn counterclockwise as seen from above, which is outside if the solid lies below.
      const bool flip = parts_.is_below(f);
      const std::span<const SHalfedgeId> corners = complex_.corners_of(f);
      if (options_.face_marks) note_marks(complex_.facets[f], flip);
      // The outer cycle has three corners at least.
      if (corners.size() == 3 && !(has_points && complex_.facets[f].isolated_count != 0)) {
        push_triangle({parts_.number(corners[0]), parts_.number(corners[1]), parts_.number(corners[2])}, flip);
      } else {
        write_polygon(complex_.facets[f], flip, triangulator);
      }
    }
    if (options_.face_marks) fill_marks();
    faces_.face_begin.resize(face_count_ + 1);
    faces_.corners.resize(corner_count_);
    return std::move(faces_);
  }

 private:
  void count_corners() {
    const bool has_points = !complex_.isolated_vertices.empty();
    for (const FacetId f : parts_.facets()) {
      const Facet facet = complex_.facets[f];
      const std::size_t corners = complex_.corners_of(facet).size();
      corner_count_ += corners;
      cycle_count_ += facet.cycle_count;
      if (corners != 3 || (has_points && facet.isolated_count != 0)) polygon_corners_ += corners;
    }
  }

  void collect_rings(const Facet& facet) {
    const std::span<const SHalfedgeId> corners = complex_.corners_of(facet);
    rings_.clear();
    for (const SHalfedgeId corner : corners) rings_.push_back(parts_.number(corner));
    ring_end_.clear();
    for (const CycleId cycle : facet.cycles()) {
      ring_end_.push_back(complex_.cycle_begin[cycle.next()] - complex_.cycle_begin[facet.first_cycle]);
    }
    // Where another part of the boundary touches the facet in a point, triangles end, too.
    for (const VertexId v : complex_.isolated_vertices_of(facet)) {
      if (parts_.number(v) == ExportedParts::kUnused) continue;
      rings_.push_back(parts_.number(v));
      ring_end_.push_back(static_cast<std::uint32_t>(rings_.size()));
    }
  }

  // A ring that meets itself is no polygon for most readers.
  bool may_stay_polygon(const std::vector<std::uint32_t>& ring) {
    if (options_.polygon_corner) {
      passes_.resize(parts_.places().size(), Answer::kUnknown);
      for (const std::uint32_t v : ring) {
        if (passes_[v] == Answer::kUnknown) {
          const Rational3 corner = complex_.points.rational(parts_.places()[v]);
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
  [[nodiscard]] MeshPoints points_of_polygons() const {
    if (polygon_corners_ == 0) return MeshPoints(PointTable());
    std::vector<std::uint32_t> asked;  // all, unless these are much fewer
    if (polygon_corners_ < parts_.places().size() / 2 && complex_.isolated_vertices.empty()) {
      asked.reserve(polygon_corners_);
      for (const FacetId f : parts_.facets()) {
        const std::span<const SHalfedgeId> corners = complex_.corners_of(f);
        if (corners.size() == 3) continue;
        for (const SHalfedgeId corner : corners) asked.push_back(parts_.number(corner));
      }
    }
    return MeshPoints(complex_.points, parts_.places(), doubles_, asked);
  }

  // As many as there are if none stays a polygon: a facet of n corners in c cycles with i points inside is
  // n + 2 c - 4 + 2 i triangles.
  void reserve_faces() {
    std::size_t count = corner_count_ + 2 * cycle_count_ + 2 * complex_.isolated_vertices.size();
    count -= 4 * parts_.facets().size();
    faces_.face_begin.resize(options_.keep_polygons ? parts_.facets().size() + 1 : count + 1);
    faces_.corners.resize(options_.keep_polygons ? corner_count_ : 3 * count);
    corner_count_ = 0;
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
    faces_.face_marks.push_back(marks);
  }
  // A facet may be many faces.
  void fill_marks() {
    if (!faces_.face_marks.empty()) faces_.face_marks.resize(face_count_, faces_.face_marks.back());
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

  enum class Answer : std::uint8_t { kUnknown, kYes, kNo };

  const ExportedParts& parts_;
  const Complex& complex_;
  std::span<const std::array<double, 3>> doubles_;
  const MeshExportOptions& options_;
  const Monitor& monitor_;
  std::size_t cycle_count_ = 0;                    // of facets of the boundary
  std::size_t polygon_corners_ = 0;                // those of facets that are no triangles
  std::vector<Answer> passes_;                     // of each vertex of the mesh: may it be a corner of a polygon?
  std::vector<std::uint32_t> rings_;               // of one facet, of vertices of the mesh
  std::vector<std::uint32_t> ring_end_;            // and where in these each ring ends
  std::vector<Triangulator::Triangle> triangles_;  // of one facet
  ExportedFaces faces_;
  std::size_t face_count_ = 0;    // of faces_, whose arrays are longer until all are there
  std::size_t corner_count_ = 0;  // likewise
};

}  // namespace

ExportedFaces exported_faces(const ExportedParts& parts, std::span<const std::array<double, 3>> doubles,
                             const MeshExportOptions& options, const Monitor& monitor) {
  return FaceWriter(parts, doubles, options, monitor).write();
}

}  // namespace nef
