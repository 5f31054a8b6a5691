// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/facet_plane.h"

#include <cmath>

#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

PlaneAxes::PlaneAxes(const PlaneTable& planes, PlaneId plane) {
  const std::array<double, 4>& n = planes.approximate(plane);
  std::size_t drop = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::fabs(n[i]) > std::fabs(n[drop])) drop = i;
  }
  // The largest component is at least 1/2 in these doubles, so it is truly not zero.
  first = static_cast<int>((drop + 1) % 3);
  second = static_cast<int>((drop + 2) % 3);
  dropped = static_cast<int>(drop);
  positive = n[drop] > 0;
}

int PlaneAxes::compare(const PointTable& points, PointId a, PointId b, const Monitor& monitor) const {
  const int sign = compare_coordinate(points, a, b, first, monitor);
  return sign != 0 ? sign : compare_coordinate(points, a, b, second, monitor);
}

EdgeSide edge_side(const PlaneTable& planes, PlaneId plane, const SVertex& s, const Monitor& monitor) {
  // With F = plane (unflipped normal f) and d = n_p x n_q: the left normal in the plane is f x d.
  // If p is F (up to orientation) and d = k f x g for k = +-1 and g the normal of the other plane,
  // then (f x d) . g = k ((f . g)^2 - |f|^2 |g|^2) < 0 for k = 1: left is the side of -k.
  if (s.p.row() == plane.row()) return {s.q.unflipped(), s.p.flipped() != s.q.flipped() ? 1 : -1};
  if (s.q.row() == plane.row()) return {s.p.unflipped(), s.p.flipped() != s.q.flipped() ? -1 : 1};
  const PlaneId other = s.p.unflipped();
  const Direction d = direction_of(planes, s);
  const Direction left = Direction::cross(Direction::normal(planes, plane.unflipped()), d);
  return {other, sign_of_dot(left, Direction::normal(planes, other), monitor)};
}

int side_of_edge(const Complex& complex, PlaneId plane, HalfedgeId halfedge, const PointTable& points, PointId point,
                 const Monitor& monitor) {
  const EdgeSide side = edge_side(complex.planes, plane, complex.svertex(halfedge), monitor);
  return side.left * side_of_plane(complex.planes, side.other, points, point, monitor);
}

}  // namespace nef
