// SPDX-License-Identifier: Apache-2.0
//
// Sets on the sphere by themselves: laws and membership on random unions of half-spheres, arcs,
// circles and points with small integer normals, where coincidences are the rule.
#include "nef/sphere_map/spherical_polyhedron.h"

#include <rapidcheck.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <vector>

#include "nef/base/error.h"

namespace {

using nef::SphericalPolyhedron;

// A set with its membership known by arithmetic.
struct Known {
  SphericalPolyhedron set;
  std::function<bool(const std::array<int, 3>&)> holds;
  std::vector<std::array<int, 3>> circles;  // normals of all great circles on which its boundary can lie
};

int dot(const std::array<int, 3>& a, const std::array<int, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::array<int, 3> cross(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

nef::Integer3 big(const std::array<int, 3>& v) { return {v[0], v[1], v[2]}; }

bool is_zero(const std::array<int, 3>& v) { return v == std::array<int, 3>{0, 0, 0}; }

std::array<int, 3> random_direction() {
  const auto component = [] { return *rc::gen::inRange(-2, 3); };
  std::array<int, 3> v{component(), component(), component()};
  if (is_zero(v)) v[2] = 1;
  return v;
}

Known random_simple() {
  const std::array<int, 3> n = random_direction();
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return {SphericalPolyhedron::half_sphere(big(n)), [n](const auto& x) { return dot(n, x) <= 0; }, {n}};
    case 1:
      return {SphericalPolyhedron::half_sphere(big(n), false), [n](const auto& x) { return dot(n, x) < 0; }, {n}};
    case 2:
      return {SphericalPolyhedron::great_circle(big(n)), [n](const auto& x) { return dot(n, x) == 0; }, {n}};
    case 3:
      return {
          SphericalPolyhedron::point(big(n)), [n](const auto& x) { return is_zero(cross(n, x)) && dot(n, x) > 0; }, {}};
    default: {
      const std::array<int, 3> m = random_direction();
      const std::array<int, 3> plane = cross(n, m);
      if (is_zero(plane)) {
        return {SphericalPolyhedron::point(big(n)),
                [n](const auto& x) { return is_zero(cross(n, x)) && dot(n, x) > 0; },
                {}};
      }
      return {SphericalPolyhedron::great_arc(big(n), big(m)),
              [n, m, plane](const auto& x) {
                return dot(plane, x) == 0 && dot(cross(n, x), plane) >= 0 && dot(cross(x, m), plane) >= 0 &&
                       !(is_zero(cross(n, x)) && dot(n, x) < 0) && !(is_zero(cross(m, x)) && dot(m, x) < 0);
              },
              {plane}};
    }
  }
}

Known random_set(int size) {
  Known result = random_simple();
  for (int i = 0; i < size; ++i) {
    const Known next = random_simple();
    const auto f = result.holds;
    const auto g = next.holds;
    std::vector<std::array<int, 3>> circles = result.circles;
    circles.insert(circles.end(), next.circles.begin(), next.circles.end());
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        result = {unite(result.set, next.set), [f, g](const auto& x) { return f(x) || g(x); }, circles};
        break;
      case 1:
        result = {intersect(result.set, next.set), [f, g](const auto& x) { return f(x) && g(x); }, circles};
        break;
      case 2:
        result = {subtract(result.set, next.set), [f, g](const auto& x) { return f(x) && !g(x); }, circles};
        break;
      default:
        result = {symmetric_difference(result.set, next.set), [f, g](const auto& x) { return f(x) != g(x); }, circles};
    }
  }
  return result;
}

// Directions so near to p that they lie in all items around it: on both sides of p along every circle through it, and
// in every sector between these circles. Normals are at most 8, components of p at most 2, so 10^6 is near enough.
std::vector<std::array<int, 3>> neighbours(const Known& known, const std::array<int, 3>& p) {
  const bool along_x = p[1] == 0 && p[2] == 0;
  std::vector<std::array<int, 3>> tangents{cross(p, along_x ? std::array{0, 1, 0} : std::array{1, 0, 0})};
  for (const std::array<int, 3>& n : known.circles) {
    const std::array<int, 3> t = cross(n, p);
    if (dot(n, p) != 0 || is_zero(t)) continue;
    tangents.push_back(t);
    tangents.push_back({-t[0], -t[1], -t[2]});
  }
  std::vector<std::array<int, 3>> steps = tangents;
  for (const std::array<int, 3>& t : tangents) {
    steps.push_back(cross(p, t));
    for (const std::array<int, 3>& u : tangents) steps.push_back({t[0] + u[0], t[1] + u[1], t[2] + u[2]});
  }
  std::vector<std::array<int, 3>> result;
  constexpr int kFar = 1000000;
  for (const std::array<int, 3>& s : steps) {
    if (!is_zero(s)) result.push_back({kFar * p[0] + s[0], kFar * p[1] + s[1], kFar * p[2] + s[2]});
  }
  return result;
}

template <typename Property>
void check(const std::string& name, Property&& property) {
  REQUIRE(rc::check(name, std::forward<Property>(property)));
}

}  // namespace

TEST_CASE("membership on the sphere follows the operations") {
  check("every small direction", [] {
    const Known known = random_set(*rc::gen::inRange(0, 6));
    for (int x = -3; x <= 3; ++x) {
      for (int y = -3; y <= 3; ++y) {
        for (int z = -3; z <= 3; ++z) {
          const std::array<int, 3> d{x, y, z};
          if (!is_zero(d)) RC_ASSERT(known.set.contains(big(d)) == known.holds(d));
        }
      }
    }
  });
}

TEST_CASE("laws of sets on the sphere") {
  check("De Morgan, absorption, difference, topology", [] {
    const SphericalPolyhedron a = random_set(*rc::gen::inRange(0, 4)).set;
    const SphericalPolyhedron b = random_set(*rc::gen::inRange(0, 4)).set;
    RC_ASSERT(equal(complement(unite(a, b)), intersect(complement(a), complement(b))));
    RC_ASSERT(equal(unite(a, intersect(a, b)), a));
    RC_ASSERT(equal(unite(subtract(a, b), intersect(a, b)), a));
    RC_ASSERT(symmetric_difference(a, a).is_empty());
    RC_ASSERT(equal(interior(a), complement(closure(complement(a)))));
    RC_ASSERT(equal(boundary(a), subtract(closure(a), interior(a))));
    RC_ASSERT(equal(regularize(regularize(a)), regularize(a)));
  });
}

TEST_CASE("topology on the sphere follows what lies around a direction") {
  check("interior, closure, boundary, regularization", [] {
    const Known known = random_set(*rc::gen::inRange(0, 5));
    const SphericalPolyhedron inner = interior(known.set);
    const SphericalPolyhedron closed = closure(known.set);
    const SphericalPolyhedron border = boundary(known.set);
    const SphericalPolyhedron regular = regularize(known.set);
    for (int k = 0; k < 12; ++k) {
      const std::array<int, 3> p = random_direction();
      bool all = known.holds(p);
      bool any = all;
      bool region = false;
      for (const std::array<int, 3>& x : neighbours(known, p)) {
        const bool in = known.holds(x);
        all = all && in;
        any = any || in;
        const auto meets = [&x](const std::array<int, 3>& n) { return dot(n, x) == 0; };
        region = region || (in && std::none_of(known.circles.begin(), known.circles.end(), meets));
      }
      RC_ASSERT(inner.contains(big(p)) == all);
      RC_ASSERT(closed.contains(big(p)) == any);
      RC_ASSERT(border.contains(big(p)) == (any && !all));
      RC_ASSERT(regular.contains(big(p)) == region);
    }
  });
}

TEST_CASE("the octant is bounded by three arcs") {
  SphericalPolyhedron octant = SphericalPolyhedron::whole_sphere();
  for (int axis = 0; axis < 3; ++axis) {
    nef::Integer3 n{0, 0, 0};
    n[static_cast<std::size_t>(axis)] = -1;
    octant = intersect(octant, SphericalPolyhedron::half_sphere(n));
  }
  CHECK(octant.map().svertices.size() == 3);
  CHECK(octant.map().shalfedges.size() == 6);
  CHECK(octant.map().sfaces.size() == 2);
  CHECK(octant.contains({1, 1, 1}));
  CHECK(octant.contains({1, 0, 0}));
  CHECK_FALSE(octant.contains({1, 1, -1}));
  CHECK(equal(interior(octant), subtract(octant, boundary(octant))));
}

TEST_CASE("what names no arc is refused") {
  CHECK_THROWS_AS(SphericalPolyhedron::great_arc({1, 0, 0}, {-2, 0, 0}), nef::InputError);
  CHECK_THROWS_AS(SphericalPolyhedron::half_sphere({0, 0, 0}), nef::InputError);
}
