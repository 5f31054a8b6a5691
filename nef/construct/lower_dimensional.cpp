// SPDX-License-Identifier: Apache-2.0
//
// Points, segments and polygons as sets of their own dimension.
#include <algorithm>
#include <numeric>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/plane_finder.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/polygon/simple_ring.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

Direction integer_direction(const Rational3& v) {
  const Integer3 d = primitive(v);
  return Direction::exact(d[0], d[1], d[2]);
}

// The direction `v` as the meeting of two planes through it.
Direction direction_in(const PlaneTable& planes, PlaneId p, PlaneId q, const Rational3& v, const Monitor& monitor) {
  Direction d = Direction::cross(planes, p, q);
  return sign_of_dot(d, integer_direction(v), monitor) > 0 ? d : d.negated();
}

// The normal of the plane of all rings. Throws InputError if they do not lie in one.
Rational3 normal_of_rings(std::span<const std::vector<Rational3>> rings) {
  Rational3 normal;
  for (const std::vector<Rational3>& ring : rings) {
    if (ring.size() < 3) throw InputError("a polygon needs at least three points");
    if (is_zero(normal)) normal = normal_of(std::span<const Rational3>(ring));
  }
  if (is_zero(normal)) throw InputError("the points of the polygon lie on one line; write it as a segment");
  const Rational offset = dot(normal, rings[0][0]);
  for (const std::vector<Rational3>& ring : rings) {
    for (const Rational3& p : ring) {
      if (dot(normal, p) != offset) throw InputError("the points of the polygon do not lie in one plane");
    }
  }
  return normal;
}

void require_simple(const std::vector<Rational3>& ring, const Rational3& normal, const Monitor& monitor) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] == ring[(i + 1) % ring.size()]) throw InputError("a ring of the polygon repeats a point");
  }
  const std::size_t axis = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
  std::vector<std::uint32_t> corners(ring.size());
  std::iota(corners.begin(), corners.end(), 0U);
  const std::array end{static_cast<std::uint32_t>(corners.size())};
  const auto sides = sides_that_meet(MeshPoints(ring), corners, end, axis, monitor);
  if (!sides) return;
  const auto name = [&](std::uint32_t side) {
    return std::to_string(side) + "-" + std::to_string((side + 1) % ring.size());
  };
  throw InputError("a ring of the polygon crosses or touches itself: its sides " + name((*sides)[0]) + " and " +
                   name((*sides)[1]) + " meet (points counted from 0); split it into simple polygons");
}

// The closed polygon inside one ring that is simple.
Polyhedron fill_ring(std::vector<Rational3> points, const Rational3& normal, const Monitor& monitor) {
  PlaneTable planes;
  ComplexBuilder builder(planes, monitor);
  const PlaneId plane = plane_through(planes, normal, points[0]);
  Rational3 area;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rational3 term = cross(minus(points[i], points[0]), minus(points[(i + 1) % points.size()], points[0]));
    for (std::size_t k = 0; k < 3; ++k) area[k] += term[k];
  }
  if (dot(area, normal) < 0) std::reverse(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rational3& here = points[i];
    const Rational3 ahead = minus(points[(i + 1) % points.size()], here);
    const Rational3 back = minus(points[(i + points.size() - 1) % points.size()], here);
    Arrangement drawing;
    drawing.centre = 1;
    for (const Rational3& v : {ahead, back}) {
      Arrangement::Node node;
      node.direction = direction_in(planes, plane, plane_through(planes, cross(v, normal), here), v, monitor);
      node.mark = 1;
      drawing.nodes.push_back(std::move(node));
    }
    drawing.arcs.push_back({plane, 0, 1, 1, 0, 0});
    builder.add(here, drawing);
  }
  return Polyhedron(builder.finish(0));
}

}  // namespace

Polyhedron make_point(const Rational3& point, const Monitor& monitor) {
  PlaneTable planes;
  ComplexBuilder builder(planes, monitor);
  Arrangement drawing;
  drawing.centre = 1;
  builder.add(point, drawing);
  return Polyhedron(builder.finish(0));
}

Polyhedron make_segment(const Rational3& a, const Rational3& b, const Monitor& monitor) {
  const Rational3 d = minus(b, a);
  if (is_zero(d)) return make_point(a, monitor);
  PlaneTable planes;
  ComplexBuilder builder(planes, monitor);
  const Rational3 n1 = across(d);
  const PlaneId p = plane_through(planes, n1, a);
  const PlaneId q = plane_through(planes, cross(d, n1), a);
  for (const bool at_a : {true, false}) {
    Arrangement drawing;
    drawing.centre = 1;
    Arrangement::Node node;
    node.direction = direction_in(planes, p, q, at_a ? d : minus(a, b), monitor);
    node.mark = 1;
    drawing.nodes.push_back(std::move(node));
    builder.add(at_a ? a : b, drawing);
  }
  return Polyhedron(builder.finish(0));
}

Polyhedron make_polygon(std::span<const std::vector<Rational3>> rings, const Monitor& monitor) {
  const Rational3 normal = normal_of_rings(rings);
  // Each ring by itself; parity combines them.
  Polyhedron result;
  for (const std::vector<Rational3>& ring : rings) {
    require_simple(ring, normal, monitor);
    const Polyhedron piece = fill_ring(ring, normal, monitor);
    // Rings may touch: the parity of the closed sets loses points of the boundary, its closure has them.
    result = result.is_empty() ? piece : closure(symmetric_difference(result, piece, monitor), monitor);
  }
  return result;
}

}  // namespace nef
