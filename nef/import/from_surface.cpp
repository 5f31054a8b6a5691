// SPDX-License-Identifier: Apache-2.0
#include "nef/import/from_surface.h"

#include <algorithm>
#include <optional>

#include "nef/base/error.h"
#include "nef/geometry/ids.h"
#include "nef/geometry/vectors.h"
#include "nef/import/contact_groups.h"
#include "nef/import/mesh_faces.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/mesh/surface/surface_contacts.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

// What a ring in a plane of this normal encloses an odd number of times, with its sides. Pyramids over the triangles of
// a fan, with one apex, are combined by parity: what that leaves of lower dimension, regularization removes.
void add_enclosed(const std::vector<Rational3>& ring, const Rational3& normal, std::vector<Polyhedron>& out,
                  const Monitor& monitor) {
  const Rational3 apex{ring[0][0] + normal[0], ring[0][1] + normal[1], ring[0][2] + normal[2]};
  Polyhedron cone;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Rational3 corners[4] = {ring[0], ring[i], ring[i + 1], apex};
    cone = symmetric_difference(cone, regularize(convex_hull(corners, monitor), monitor), monitor);
  }
  const Rational offset = dot(normal, ring[0]);
  out.push_back(intersect(regularize(cone, monitor),
                          make_halfspace(normal[0], normal[1], normal[2], -offset, true, monitor), monitor));
  for (std::size_t i = 0; i < ring.size(); ++i)
    out.push_back(make_segment(ring[i], ring[(i + 1) % ring.size()], monitor));
}

// The normal of the plane of the points; the zero vector if they lie on a line, nothing if they lie in no plane.
std::optional<Rational3> normal_if_planar(const std::vector<Rational3>& points) {
  const Rational3 normal = normal_of<Rational>(points);
  for (const Rational3& p : points) {
    if (dot(normal, minus(p, points[0])) != 0) return std::nullopt;
  }
  return normal;
}

// A face that is degenerate or touches or crosses itself.
void add_single(const Mesh& mesh, const MeshSurface& surface, std::uint32_t f, std::vector<Polyhedron>& out,
                const Monitor& monitor) {
  std::vector<std::uint32_t> ring;
  for (const std::uint32_t v : mesh.face(f)) {
    if (ring.empty() || ring.back() != surface.place[v]) ring.push_back(surface.place[v]);
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  if (ring.size() < 3) return;
  std::vector<Triangulator::Triangle> triangles;
  // Their union is the polygon, if it is one that touches itself at most from within.
  if (Triangulator(surface.points, monitor).cut(ring, triangles) == Triangulator::Cut::kFailed) {
    std::vector<Rational3> points;
    for (const std::uint32_t v : ring) points.push_back(mesh.vertices[v]);
    if (const std::optional<Rational3> normal = normal_if_planar(points); normal && !is_zero(*normal)) {
      add_enclosed(points, *normal, out, monitor);
      return;
    }
    // On a line, or bent and crossing itself however one looks at it: a fan keeps the corners.
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) triangles.push_back({ring[0], ring[i], ring[i + 1]});
  }
  for (const Triangulator::Triangle& t : triangles) {
    const Rational3 corners[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    out.push_back(convex_hull(corners, monitor));
  }
}

}  // namespace

Polyhedron from_surface(const Mesh& mesh, const MeshSurface& surface, const MeshOptions& options, Messages* messages) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (surface.defects[f] != FaceDefect::kBadIndex) continue;
    for (const std::uint32_t v : mesh.face(f)) {
      if (v < mesh.vertices.size()) continue;
      throw InputError("face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", which does not exist");
    }
  }
  const std::vector<FaceContact> contacts = face_contacts(surface, SurfaceContacts(surface, options.monitor));
  std::vector<bool> single(mesh.face_count(), false);  // faces that cannot be in any group
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    single[f] = surface.defects[f] != FaceDefect::kNone || surface.irregular[f];
  }
  for (const FaceContact& contact : contacts) {
    if (contact.f == contact.g) single[contact.f] = true;
  }
  std::vector<Polyhedron> parts;
  std::vector<std::uint32_t> components = face_components(mesh, surface);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (single[f]) components[f] = kNone;
  }
  MeshFaces faces(mesh, surface, options, messages);
  for (const std::vector<std::uint32_t>& group : contact_groups(contacts, components)) {
    parts.emplace_back(faces.surface(group));
  }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (single[f]) add_single(mesh, surface, f, parts, options.monitor);
  }
  return unite_all(parts, options.monitor);
}

}  // namespace nef
