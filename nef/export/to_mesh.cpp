// SPDX-License-Identifier: Apache-2.0
#include "nef/export/to_mesh.h"

#include <utility>

#include "nef/export/exported_faces.h"
#include "nef/export/exported_parts.h"
#include "nef/export/lost_features.h"
#include "nef/number/nearest_quotient.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

std::vector<std::array<double, 3>> nearest_to_places(const PointTable& points, std::span<const PointId> places) {
  std::vector<std::array<double, 3>> doubles;
  doubles.reserve(places.size());
  const bool all_are_nearest = points.all_are_nearest();  // of those that are finite, as these are
  for (const PointId p : places) {
    doubles.push_back(all_are_nearest ? points.approximate(p) : nearest_doubles(points, p));
  }
  return doubles;
}

}  // namespace

std::array<double, 3> nearest_doubles(const PointTable& points, PointId point) {
  if (points.is_nearest(point)) return points.approximate(point);
  const std::array<IntegerView, 4> h = points.coordinates(point);
  return {nearest_quotient(h[0], h[3]), nearest_quotient(h[1], h[3]), nearest_quotient(h[2], h[3])};
}

RoundedMeshExport to_rounded_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options,
                                  const Monitor& monitor) {
  const Complex& complex = polyhedron.complex();
  const ExportedParts parts(complex, options);
  RoundedMeshExport result;
  result.mesh.vertices = nearest_to_places(complex.points, parts.places());
  ExportedFaces faces = exported_faces(parts, result.mesh.vertices, options, monitor);
  result.mesh.face_begin = std::move(faces.face_begin);
  result.mesh.corners = std::move(faces.corners);
  result.lost = lost_features(parts).lines();
  return result;
}

MeshExport to_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options, const Monitor& monitor) {
  const Complex& complex = polyhedron.complex();
  const ExportedParts parts(complex, options);
  std::vector<std::array<double, 3>> doubles;
  doubles.reserve(parts.places().size());
  for (const PointId p : parts.places()) doubles.push_back(complex.points.approximate(p));
  ExportedFaces faces = exported_faces(parts, doubles, options, monitor);
  MeshExport result;
  result.mesh.vertices.reserve(parts.places().size());
  for (const PointId p : parts.places()) result.mesh.vertices.push_back(complex.points.rational(p));
  result.mesh.face_begin = std::move(faces.face_begin);
  result.mesh.corners = std::move(faces.corners);
  result.closed = !parts.lower_dimensional();
  for (const auto& [v, w] : parts.lines()) result.lines.push_back({parts.number(v), parts.number(w)});
  for (const VertexId v : parts.points()) result.points.push_back(parts.number(v));
  result.lost = lost_features(parts).lines();
  result.face_marks = std::move(faces.face_marks);
  return result;
}

}  // namespace nef
