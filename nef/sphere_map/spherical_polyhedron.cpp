// SPDX-License-Identifier: Apache-2.0
//
// All is done by what 3D sets use: sets are drawn as an `Arrangement`, Booleans are `SphereOverlay`, topological
// operations change marks and simplify again. The centre of the map has no meaning here and keeps the mark 0. Planes
// are interned with offset 0, so that parallel planes are one.
#include "nef/sphere_map/spherical_polyhedron.h"

#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/sphere_map/overlay.h"

namespace nef {
namespace {

void require_direction(const Integer3& v) {
  if (is_zero(v)) throw InputError("(0,0,0) is not a direction");
}

PlaneId intern(PlaneTable& planes, const Integer3& normal) { return planes.intern(normal[0], normal[1], normal[2], 0); }

// The direction v as the meeting of the plane of `circle`, which holds it, and a second one:
// n x (v x n) = v (n.n).
Arrangement::Node node_on(PlaneTable& planes, const Integer3& circle, const Integer3& v) {
  const PlaneId p = intern(planes, circle);
  const PlaneId q = intern(planes, cross(v, circle));
  Arrangement::Node node;
  node.direction = Direction::cross(planes, p, q);
  node.mark = 1;
  return node;
}

Integer3 any_orthogonal(const Integer3& v) {
  return v[0] == 0 && v[1] == 0 ? Integer3{1, 0, 0} : Integer3{Integer(-v[1]), v[0], 0};
}

SphereMapView renamed(const SphereMapView& map, const PlaneTable& from, PlaneTable& to, SphereMapBuffer& copy) {
  copy.svertices.assign(map.svertices.begin(), map.svertices.end());
  copy.shalfedges.assign(map.shalfedges.begin(), map.shalfedges.end());
  copy.sloops.assign(map.sloops.begin(), map.sloops.end());
  copy.sfaces.assign(map.sfaces.begin(), map.sfaces.end());
  copy.entries.assign(map.entries.begin(), map.entries.end());
  copy.mark = 0;
  // Only normals count here: parallel planes of a complex are one.
  const auto rename = [&](PlaneId& plane) {
    plane = to.intern(from.oriented_coefficient(plane, 0), from.oriented_coefficient(plane, 1),
                      from.oriented_coefficient(plane, 2), 0);
  };
  for (SVertex& v : copy.svertices) {
    rename(v.p);
    rename(v.q);
  }
  for (SHalfedge& e : copy.shalfedges) rename(e.plane);
  for (SLoop& l : copy.sloops) rename(l.plane);
  return copy.view();
}

}  // namespace

SphericalPolyhedron::SphericalPolyhedron() {
  Body body;
  body.map.assign_trivial(0);
  body_ = std::make_shared<const Body>(std::move(body));
}

SphericalPolyhedron::SphericalPolyhedron(const PlaneTable& planes, const SphereMapView& map) {
  Body body;
  renamed(map, planes, body.planes, body.map);
  body_ = std::make_shared<const Body>(std::move(body));
}

SphericalPolyhedron SphericalPolyhedron::whole_sphere() { return complement(SphericalPolyhedron()); }

SphericalPolyhedron SphericalPolyhedron::half_sphere(const Integer3& normal, bool closed) {
  require_direction(normal);
  Body body;
  body.map.assign_circle(intern(body.planes, normal), closed ? 1 : 0, 0, 1);
  body.map.mark = 0;
  return SphericalPolyhedron(std::move(body));
}

SphericalPolyhedron SphericalPolyhedron::great_circle(const Integer3& normal, const Monitor& monitor) {
  return boundary(half_sphere(normal), monitor);
}

SphericalPolyhedron SphericalPolyhedron::great_arc(const Integer3& a, const Integer3& b, const Monitor& monitor) {
  require_direction(a);
  require_direction(b);
  const Integer3 n = cross(a, b);
  if (is_zero(n)) {
    if (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0) return point(a, monitor);
    throw InputError("two opposite directions do not determine a great arc; join them by way of a third one");
  }
  Body body;
  Arrangement drawing;
  drawing.nodes.push_back(node_on(body.planes, n, a));
  drawing.nodes.push_back(node_on(body.planes, n, b));
  drawing.arcs.push_back({intern(body.planes, n), 0, 1, 1, 0, 0});
  drawing.sort_around_nodes(body.planes, monitor);
  drawing.simplify_and_assemble(body.planes, body.map, monitor);
  return SphericalPolyhedron(std::move(body));
}

SphericalPolyhedron SphericalPolyhedron::point(const Integer3& direction, const Monitor& monitor) {
  require_direction(direction);
  Body body;
  Arrangement drawing;
  drawing.nodes.push_back(node_on(body.planes, any_orthogonal(direction), direction));
  drawing.sort_around_nodes(body.planes, monitor);
  drawing.simplify_and_assemble(body.planes, body.map, monitor);
  return SphericalPolyhedron(std::move(body));
}

SphereLocation SphericalPolyhedron::locate(const Integer3& direction) const {
  require_direction(direction);
  return nef::locate(planes(), map(), Direction::exact(direction[0], direction[1], direction[2]), {});
}

bool SphericalPolyhedron::contains(const Integer3& direction) const { return mark_at(map(), locate(direction)) != 0; }

SphericalPolyhedron combine(const SphericalPolyhedron& a, const SphericalPolyhedron& b, LabelId (*f)(LabelId, LabelId),
                            const Monitor& monitor) {
  SphericalPolyhedron::Body body;
  SphereMapBuffer copies[2];
  const SphereMapView map_a = renamed(a.map(), a.planes(), body.planes, copies[0]);
  const SphereMapView map_b = renamed(b.map(), b.planes(), body.planes, copies[1]);
  SphereOverlay().overlay(body.planes, map_a, map_b, LabelFunction(2, 2, f), body.map, monitor);
  body.map.mark = 0;
  return SphericalPolyhedron(std::move(body));
}

SphericalPolyhedron unite(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor) {
  return combine(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x | y); }, monitor);
}

SphericalPolyhedron intersect(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor) {
  return combine(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x & y); }, monitor);
}

SphericalPolyhedron subtract(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor) {
  return combine(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y == 0); }, monitor);
}

SphericalPolyhedron symmetric_difference(const SphericalPolyhedron& a, const SphericalPolyhedron& b,
                                         const Monitor& monitor) {
  return combine(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x ^ y); }, monitor);
}

bool equal(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor) {
  return symmetric_difference(a, b, monitor).is_empty();
}

SphericalPolyhedron complement(const SphericalPolyhedron& a) {
  SphericalPolyhedron::Body body = *a.body_;
  const auto flip = [](LabelId& mark) { mark = mark == 0 ? 1 : 0; };
  for (SVertex& item : body.map.svertices) flip(item.mark);
  for (SHalfedge& item : body.map.shalfedges) flip(item.mark);
  for (SLoop& item : body.map.sloops) flip(item.mark);
  for (SFace& item : body.map.sfaces) flip(item.mark);
  return SphericalPolyhedron(std::move(body));
}

// In a simplified map all svertices, shalfedges and sloops are boundary items.
SphericalPolyhedron change_marks(const SphericalPolyhedron& a, bool select_lower, bool keep_faces,
                                 const Monitor& monitor) {
  SphericalPolyhedron::Body body = *a.body_;
  const LabelId lower = select_lower ? 1 : 0;
  for (SVertex& item : body.map.svertices) item.mark = lower;
  for (SHalfedge& item : body.map.shalfedges) item.mark = lower;
  for (SLoop& item : body.map.sloops) item.mark = lower;
  for (SFace& item : body.map.sfaces) {
    if (!keep_faces) item.mark = 0;
  }
  Arrangement drawing;
  drawing.load(body.planes, body.map.view());
  drawing.sort_around_nodes(body.planes, monitor);
  drawing.simplify_and_assemble(body.planes, body.map, monitor);
  body.map.mark = 0;
  return SphericalPolyhedron(std::move(body));
}

SphericalPolyhedron interior(const SphericalPolyhedron& a, const Monitor& monitor) {
  return change_marks(a, false, true, monitor);
}

SphericalPolyhedron closure(const SphericalPolyhedron& a, const Monitor& monitor) {
  return change_marks(a, true, true, monitor);
}

SphericalPolyhedron boundary(const SphericalPolyhedron& a, const Monitor& monitor) {
  return change_marks(a, true, false, monitor);
}

SphericalPolyhedron regularize(const SphericalPolyhedron& a, const Monitor& monitor) {
  return closure(interior(a, monitor), monitor);
}

}  // namespace nef
