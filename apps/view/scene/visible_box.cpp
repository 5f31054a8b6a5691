// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "apps/view/scene.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/number/floor.h"

namespace nef::view {
namespace {

struct Extent {
  Rational3 low, high;
  bool any = false;

  void add(const Rational3& point) {
    if (!any) {
      low = high = point;
      any = true;
      return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (point[i] < low[i]) low[i] = point[i];
      if (point[i] > high[i]) high[i] = point[i];
    }
  }
};

// A vertex where only the planes of the infimaximal box meet says nothing about where the set is.
bool is_box_corner(const Complex& complex, VertexId vertex) {
  for (const SHalfedge& arc : complex.sphere_map(vertex).shalfedges) {
    if (!complex.planes.infimaximal(arc.plane)) return false;
  }
  return true;
}

// The point of a line or plane with R = 0: it lies on all the finite planes of the vertex.
Rational3 finite_part(const Complex& complex, VertexId vertex) {
  const PointId id = point_of(vertex);
  const Integer w(complex.points.coordinate(id, 3));
  Rational3 point;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = Rational(Integer(complex.points.coordinate(id, i)), w);
    point[i].canonicalize();
  }
  return point;
}

// The power of two next above a positive number: simple coordinates for a box that is not the set's own.
Rational round_up(const Rational& value) {
  Rational power = 1;
  while (power < value) power *= 2;
  while (power / 2 >= value) power /= 2;
  return power;
}

// The nearest multiples of `unit` outside.
Rational floor_to(const Rational& value, const Rational& unit) { return floor_of(Rational(value / unit)) * unit; }

void extend(Extent& extent, const Complex& complex) {
  for (const VertexId v : complex.vertex_ids()) {
    if (!is_box_vertex(complex, v)) {
      extent.add(complex.points.rational(point_of(v)));
    } else if (!is_box_corner(complex, v)) {
      extent.add(finite_part(complex, v));
    }
  }
}

}  // namespace

std::array<Rational3, 2> visible_box(std::span<const Polyhedron> sets) {
  Extent extent;
  for (const Polyhedron& set : sets) extend(extent, set.complex());
  if (!extent.any) return {Rational3{-1, -1, -1}, Rational3{1, 1, 1}};
  Rational size = 0;
  for (std::size_t i = 0; i < 3; ++i) size = std::max(size, Rational(extent.high[i] - extent.low[i]));
  // A single point or plane gives no scale; its distance from the origin does, or the unit.
  if (size == 0) size = 2;
  const Rational unit = round_up(size) / 16;
  const Rational margin = size * Rational(1, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    extent.low[i] = floor_to(extent.low[i] - margin, unit);
    extent.high[i] = -floor_to(-extent.high[i] - margin, unit);
  }
  return {extent.low, extent.high};
}

}  // namespace nef::view
