// SPDX-License-Identifier: Apache-2.0
//
// Directions that no open cone blocks, against all vertices of the arrangement of their planes: in a direction next to
// a vertex no fewer cones block than at it, so some direction is free iff one of these is.
#include "apps/planner/assembly/first_motions.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

bool is_free_of(const std::set<OpenCone>& blocked, const Rational3& d) {
  return std::none_of(blocked.begin(), blocked.end(), [&d](const OpenCone& cone) { return contains(cone, d); });
}

bool has_free_vertex(const std::set<OpenCone>& blocked) {
  std::set<Integer3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const OpenCone& cone : blocked) normals.insert(cone.begin(), cone.end());
  for (const Integer3& p : normals) {
    for (const Integer3& q : normals) {
      const Rational3 d = cross(to_rational(p), to_rational(q));
      if (!is_zero(d) && (is_free_of(blocked, d) || is_free_of(blocked, opposite(d)))) return true;
    }
  }
  return false;
}

std::set<OpenCone> random_cones(std::mt19937& random) {
  std::set<OpenCone> result;
  for (unsigned count = random() % 12; count > 0; --count) {
    OpenCone cone;
    for (unsigned k = random() % 3 == 0 ? 1 + random() % 3 : 1; k > 0; --k) {
      Integer3 n;
      do {
        for (Integer& x : n) x = static_cast<int>(random() % 5) - 2;
      } while (is_zero(n));
      cone.push_back(primitive(n));
    }
    std::sort(cone.begin(), cone.end());
    result.insert(cone);
  }
  return result;
}

TEST_CASE("a direction is free iff a vertex of the arrangement of planes is") {
  std::mt19937 random(7);
  unsigned free = 0;
  unsigned covered = 0;
  for (unsigned i = 0; i < nef::test::fewer(2000); ++i) {
    INFO("case " << i);
    const std::set<OpenCone> blocked = random_cones(random);
    const bool expected = has_free_vertex(blocked);
    const std::optional<std::vector<Integer3>> cone = free_cone(blocked);
    REQUIRE(cone.has_value() == expected);
    const std::vector<Rational3> ways = free_ways(blocked);
    CHECK(ways.empty() == !expected);
    for (const Rational3& way : ways) CHECK(is_free_of(blocked, way));
    ++(expected ? free : covered);
    if (!cone) continue;
    Rational3 between;
    for (const Integer3& ray : *cone) {
      CHECK(is_free_of(blocked, to_rational(ray)));
      const auto weight = static_cast<int>(1 + random() % 4);
      for (std::size_t k = 0; k < 3; ++k) between[k] += weight * Rational(ray[k]);
    }
    CHECK(is_free_of(blocked, between));
  }
  CHECK(free > nef::test::fewer(200));
  CHECK(covered > nef::test::fewer(200));
}

TEST_CASE("directions of parts that nothing blocks, and of parts that everything blocks") {
  CHECK(free_ways({}).size() > 6);
  CHECK_FALSE(free_cone({OpenCone{}}).has_value());
  CHECK(free_ways({OpenCone{}}).empty());
  // A peg in a hole with flat walls: one line of directions, up only.
  const std::set<OpenCone> peg{{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}};
  CHECK(free_ways(peg) == std::vector<Rational3>{{0, 0, 1}});
}

}  // namespace
}  // namespace nef::planner::test
