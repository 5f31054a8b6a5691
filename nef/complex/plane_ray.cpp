// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/plane_ray.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
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
  positive = n[drop] > 0;
}

int PlaneAxes::compare(const PointTable& points, PointId a, PointId b) const {
  const int sign = compare_coordinate(points, a, b, first);
  return sign != 0 ? sign : compare_coordinate(points, a, b, second);
}

EdgeSide edge_side(const PlaneTable& planes, PlaneId plane, const SVertex& s) {
  // With F = plane (unflipped normal f) and d = n_p x n_q: the left normal in the plane is f x d.
  // If p is F (up to orientation) and d = k f x g for k = +-1 and g the normal of the other plane,
  // then (f x d) . g = k ((f . g)^2 - |f|^2 |g|^2) < 0 for k = 1: left is the side of -k.
  if (s.p.row() == plane.row()) return {PlaneId{s.q.row() << 1U}, s.p.flipped() != s.q.flipped() ? 1 : -1};
  if (s.q.row() == plane.row()) return {PlaneId{s.p.row() << 1U}, s.p.flipped() != s.q.flipped() ? -1 : 1};
  const PlaneId other{s.p.row() << 1U};
  const Direction d = direction_of(planes, s);
  const Direction left = Direction::cross(Direction::normal(planes, PlaneId{plane.row() << 1U}), d);
  return {other, sign_of_dot(left, Direction::normal(planes, other))};
}

int side_of_edge(const Complex& complex, PlaneId plane, std::uint32_t halfedge, const PointTable& points,
                 PointId point) {
  const EdgeSide side = edge_side(complex.planes, plane, complex.svertices[halfedge]);
  return side.left * side_of_plane(complex.planes, side.other, points, point);
}

PlaneRay::PlaneRay(const Complex& complex, PlaneId plane, const PlaneAxes& axes, std::vector<PlaneRayEdge> edges)
    : c_(complex), plane_(plane), axes_(axes), edges_(std::move(edges)) {
  std::vector<Box> boxes;
  boxes.reserve(edges_.size());
  for (const PlaneRayEdge& edge : edges_) {
    Box box;
    box.add_rounded(c_.points.approximate(PointId{c_.svertex_owner[edge.halfedge]}));
    box.add_rounded(c_.points.approximate(PointId{c_.target(edge.halfedge)}));
    boxes.push_back(box);
  }
  tree_ = BoxTree(boxes);
}

std::vector<std::uint32_t> PlaneRay::owners_with_odd_parity(std::uint32_t vertex) const {
  const PointId v{vertex};
  Box ray;
  ray.add_rounded(c_.points.approximate(v));
  ray.low[static_cast<std::size_t>(axes_.first)] = -HUGE_VAL;
  // Along the ray the third coordinate follows the plane.
  const auto third = static_cast<std::size_t>(3 - axes_.first - axes_.second);
  ray.low[third] = -HUGE_VAL;
  ray.high[third] = HUGE_VAL;
  std::vector<std::uint32_t> crossed;
  tree_.for_each_overlap(ray, [&](std::uint32_t i) {
    const PlaneRayEdge& edge = edges_[i];
    const std::uint32_t a = c_.svertex_owner[edge.halfedge];
    const std::uint32_t b = c_.target(edge.halfedge);
    if (a == vertex || b == vertex) return;
    // The ray runs a hair above the vertex: ends at its height count as below.
    const bool a_above = compare_coordinate(c_.points, PointId{a}, v, axes_.second) > 0;
    const bool b_above = compare_coordinate(c_.points, PointId{b}, v, axes_.second) > 0;
    if (a_above == b_above) return;
    const int side = side_of_edge(c_, plane_, edge.halfedge, c_.points, v);
    // In (first, second) seen as x and y with the usual turn, an edge that rises has smaller x to
    // its left, so a point to its right has it on its ray.
    const bool rises = b_above;
    const int to_the_left = axes_.positive ? side : -side;
    if ((rises && to_the_left < 0) || (!rises && to_the_left > 0)) crossed.push_back(edge.owner);
  });
  std::sort(crossed.begin(), crossed.end());
  std::vector<std::uint32_t> odd;
  for (std::size_t i = 0; i < crossed.size();) {
    std::size_t j = i;
    while (j < crossed.size() && crossed[j] == crossed[i]) ++j;
    if ((j - i) % 2 == 1) odd.push_back(crossed[i]);
    i = j;
  }
  return odd;
}

}  // namespace nef
