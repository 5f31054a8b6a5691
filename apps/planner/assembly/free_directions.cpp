// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/assembly/free_directions.h"

#include <algorithm>

#include "apps/planner/assembly/blocking.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {

FreeDirections free_directions(const Assembly& assembly, std::size_t part, const Monitor& monitor) {
  const Polyhedron cube = make_box({-1, -1, -1}, {1, 1, 1}, monitor);
  std::vector<Polyhedron> allowed{cube};
  // What one body forbids is the inside of a cone: the part may go where it leaves one of its faces alone.
  for (const std::vector<Rational3>& normals : Blocking(assembly.parts, monitor).blocked_cones(part)) {
    std::vector<Polyhedron> sides;
    for (const Rational3& n : normals)
      sides.push_back(intersect(cube, make_halfspace(-n[0], -n[1], -n[2], Rational(0), true, monitor), monitor));
    allowed.push_back(unite_all(sides, monitor));
  }
  FreeDirections result;
  result.everything = allowed.size() == 1;
  result.cone = intersect_all(allowed, monitor);
  const Location apex = locate(result.cone, Rational3{});
  if (result.everything || apex.kind == Location::Kind::kVolume) {
    result.dimension = 3;
    return result;
  }
  const SphereMapBuffer around = local_pyramid(result.cone, Rational3{});
  const auto any_selected = [](const auto& items) {
    return std::any_of(items.begin(), items.end(), [](const auto& item) { return item.mark != 0; });
  };
  result.dimension = any_selected(around.sfaces)                                      ? 3
                     : any_selected(around.shalfedges) || any_selected(around.sloops) ? 2
                     : any_selected(around.svertices)                                 ? 1
                                                                                      : 0;
  for (const SVertex& ray : around.svertices) {
    if (ray.mark == 0) continue;
    Integer3 d = direction_of(result.cone.complex().planes, ray).integers();
    const Integer common = gcd(gcd(d[0], d[1]), d[2]);
    for (Integer& x : d) x /= common;
    result.rays.push_back(d);
  }
  std::sort(result.rays.begin(), result.rays.end());
  return result;
}

}  // namespace nef::planner
