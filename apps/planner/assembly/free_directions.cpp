// SPDX-License-Identifier: Apache-2.0
//
// Each stop forbids the inside of a cone, so what is free is an intersection of unions of half-spaces. Most stops are
// half-spaces themselves, and most of these superfluous: what they leave is the polar of the cone that their normals
// span, which the faces of the hull of the normals and the origin tell that pass through the origin.
#include "apps/planner/assembly/free_directions.h"

#include <algorithm>
#include <map>
#include <set>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/intersection/vectors.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {
namespace {

// Four normals around the origin, which forbid all directions: often those nearest to the directions from the middle of
// a regular tetrahedron to its corners. Empty if those are not around it.
std::set<Integer3> four_around(const std::set<Integer3>& normals) {
  static constexpr std::array<std::array<double, 3>, 4> kCorners{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
  std::array<const Integer3*, 4> nearest{};
  std::array<double, 4> best{-2, -2, -2, -2};
  for (const Integer3& n : normals) {
    const Vector3d along = Vector3d(n[0].get_d(), n[1].get_d(), n[2].get_d()).normalized();
    for (std::size_t i = 0; i < 4; ++i) {
      const double value = along.dot(Vector3d(kCorners[i][0], kCorners[i][1], kCorners[i][2]));
      if (value <= best[i]) continue;
      best[i] = value;
      nearest[i] = &n;
    }
  }
  if (std::find(nearest.begin(), nearest.end(), nullptr) != nearest.end()) return {};  // larger than doubles
  // The origin is inside of a tetrahedron iff each face has it on the side of the fourth corner.
  const auto turn = [&](std::size_t i, std::size_t j, std::size_t k) {
    return sgn(dot(cross(*nearest[i], *nearest[j]), *nearest[k]));
  };
  const int side = turn(0, 1, 2);
  if (side == 0 || turn(0, 1, 3) != -side || turn(0, 2, 3) != side || turn(1, 2, 3) != -side) return {};
  return {*nearest[0], *nearest[1], *nearest[2], *nearest[3]};
}

// Normals that span the same cone as all: no more are looked for if the cone is not flat and has few facets.
std::set<Integer3> spanning(const std::set<Integer3>& normals, const Monitor& monitor) {
  constexpr std::size_t kFew = 4;
  if (normals.size() <= kFew) return normals;
  if (std::set<Integer3> around = four_around(normals); !around.empty()) return around;
  std::vector<Rational3> points{Rational3{}};
  for (const Integer3& n : normals) points.push_back(to_rational(n));
  const minkowski::ConvexCell hull = minkowski::hull_cell(points, monitor);
  const Mesh& mesh = hull.mesh;
  std::set<Rational3> corners(mesh.vertices.begin(), mesh.vertices.end());
  if (hull.dimension == 3) {
    std::set<Rational3> at_origin;
    // With the origin inside, the cone is all of space; often four normals tell: one, and a triangle opposite to it.
    std::set<Rational3> around;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      const auto corner = [&](std::size_t i) -> const Rational3& { return mesh.vertices[face[i]]; };
      const Rational3 normal = cross(minus(corner(1), corner(0)), minus(corner(2), corner(0)));
      if (dot(normal, corner(0)) == 0) {
        for (std::size_t i = 0; i < face.size(); ++i) at_origin.insert(corner(i));
        // The cone of one face through the origin is a half-space, which takes a vector beside the face, too.
        const auto beside = [&](const Rational3& n) { return dot(normal, n) < 0; };
        at_origin.insert(*std::find_if(mesh.vertices.begin(), mesh.vertices.end(), beside));
      }
      for (std::size_t i = 1; i + 1 < face.size() && around.empty(); ++i) {
        const std::array triangle{corner(0), corner(i), corner(i + 1)};
        for (const Rational3& n : mesh.vertices) {
          const auto left_of = [&](std::size_t k) { return dot(cross(triangle[k], triangle[(k + 1) % 3]), n) < 0; };
          if (!left_of(0) || !left_of(1) || !left_of(2)) continue;
          around = {triangle.begin(), triangle.end()};
          around.insert(n);
          break;
        }
      }
    }
    if (!at_origin.empty()) {
      corners = at_origin;
    } else if (!around.empty()) {
      corners = around;
    }
  }
  std::set<Integer3> result;
  for (const Integer3& n : normals) {
    if (corners.contains(to_rational(n))) result.insert(n);
  }
  return result;
}

// What of the cube from -1 to 1 is on the side n * x <= 0: the hull of its corners there and of the points where its
// edges cross the plane.
Polyhedron half_cube(const Integer3& n, const Monitor& monitor) {
  std::vector<Rational3> points;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Rational3 x;
    for (unsigned k = 0; k < 3; ++k) x[k] = (corner >> k & 1U) != 0 ? 1 : -1;
    const Rational height = dot(to_rational(n), x);
    if (height <= 0) points.push_back(x);
    for (unsigned k = 0; k < 3; ++k) {
      // From the corner that is lower along the axis, once.
      if ((corner >> k & 1U) != 0 || sgn(height) * sgn(Rational(height + 2 * n[k])) >= 0) continue;
      Rational3 crossing = x;
      crossing[k] -= height / n[k];
      points.push_back(crossing);
    }
  }
  return convex_hull(points, monitor);
}

// The directions in which the stops begin to be in the way of a part.
std::vector<FreeDirections::Stop> stops_of(Blocking& blocking, std::size_t part, const Monitor& monitor) {
  std::vector<FreeDirections::Stop> stops;
  std::map<Integer3, std::size_t> half_spaces;  // and the first part that forbids each
  for (std::size_t other = 0; other < blocking.size(); ++other) {
    if (other == part) continue;
    for (OpenCone& cone : blocking.blocked_cones(part, other)) {
      if (cone.size() == 1) {
        half_spaces.try_emplace(cone.front(), other);
      } else {
        stops.push_back({other, std::move(cone)});
      }
    }
  }
  std::set<Integer3> normals;
  for (const auto& [normal, other] : half_spaces) normals.insert(normal);
  for (const Integer3& normal : spanning(normals, monitor)) stops.push_back({half_spaces.at(normal), {normal}});
  return stops;
}

}  // namespace

FreeDirections free_directions(Blocking& blocking, std::size_t part, const Monitor& monitor) {
  FreeDirections result;
  result.stops = stops_of(blocking, part, monitor);
  const Polyhedron cube = make_box({-1, -1, -1}, {1, 1, 1}, monitor);
  std::vector<Polyhedron> allowed{cube};
  for (const FreeDirections::Stop& stop : result.stops) {
    std::vector<Polyhedron> sides;
    for (const Integer3& n : stop.directions) sides.push_back(half_cube(opposite(n), monitor));
    allowed.push_back(unite_all(sides, monitor));
  }
  result.everything = result.stops.empty();
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
    result.rays.push_back(primitive(direction_of(result.cone.complex().planes, ray).integers()));
  }
  std::sort(result.rays.begin(), result.rays.end());
  return result;
}

FreeDirections free_directions(const Assembly& assembly, std::size_t part, const Monitor& monitor) {
  Blocking blocking(assembly.parts, monitor);
  return free_directions(blocking, part, monitor);
}

}  // namespace nef::planner
