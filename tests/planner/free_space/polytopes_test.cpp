// SPDX-License-Identifier: Apache-2.0
//
// Random scenes of polytopes in general position, non-convex robots among them: every segment of every path by the
// swept robot, and no free motion may join what the planner says is separate.
#include <catch2/catch.hpp>
#include <random>

#include "apps/minkowski/minkowski.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Rational3 point(int span) {
    Rational3 result;
    for (Rational& x : result) {
      x = Rational(number(-6 * span, 6 * span), 6);
      x.canonicalize();
    }
    return result;
  }
  // The hull of a few points about a centre, not flat.
  Polyhedron polytope(const Rational3& centre, int size) {
    for (;;) {
      std::vector<Rational3> points;
      for (int i = number(4, 7); i > 0; --i) {
        points.push_back(point(size));
        for (std::size_t k = 0; k < 3; ++k) points.back()[k] += centre[k];
      }
      Polyhedron hull = convex_hull(points);
      if (hull.is_regular()) return hull;
    }
  }

 private:
  std::mt19937 engine_;
};

Scene random_scene(Random& random) {
  Scene scene;
  scene.robot = random.polytope({}, 1);
  if (random.number(0, 1) == 0) scene.robot = unite(scene.robot, random.polytope(random.point(1), 1));
  for (int i = random.number(2, 4); i > 0; --i) {
    scene.obstacles.push_back(random.polytope(random.point(3), 2));
    scene.obstacle_names.emplace_back("polytope");
  }
  // Half of the scenes are in a thick wall that touches nothing but what sticks into it.
  if (random.number(0, 1) == 0) {
    const Polyhedron wall = subtract(make_box({-6, -6, -6}, {6, 6, 6}), interior(make_box({-4, -4, -4}, {4, 4, 4})));
    scene.obstacles.push_back(wall);
    scene.obstacle_names.emplace_back("wall");
  }
  return scene;
}

// By the definition, without any configuration space.
bool motion_is_free(const Scene& scene, const Rational3& a, const Rational3& b) {
  const Polyhedron swept = minkowski::minkowski_sum(interior(scene.robot), make_segment(a, b));
  for (const Polyhedron& obstacle : scene.obstacles) {
    if (!intersect(swept, obstacle).is_empty()) return false;
  }
  return true;
}

TEST_CASE("random polytopes: paths by the swept robot, and motions that would contradict a proof") {
  unsigned paths = 0;
  int proofs = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(25); ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Scene scene = random_scene(random);
    const Problem problem(scene);
    const FreeSpace& free = problem.free_space();
    for (int pair = 0; pair < 6; ++pair) {
      const Rational3 a = random.point(4);
      const Rational3 b = random.point(pair % 2 == 0 ? 4 : 12);
      const Answer answer = problem.solve(a, b, {});
      const bool both_free = !find_collision(scene, a) && !find_collision(scene, b);
      CHECK(both_free == (answer.status == Answer::Status::kPath || answer.status == Answer::Status::kInfeasible));
      if (!both_free) continue;
      const bool direct = motion_is_free(scene, a, b);
      CHECK(direct == !first_blocked_position(free, a, b).has_value());
      if (answer.path) {
        ++paths;
        CHECK(independent_complaint(scene, free.set(), *answer.path, true) == "");
      } else {
        ++proofs;
        CHECK_FALSE(direct);
      }
    }
  }
  CHECK(paths > nef::test::fewer(20));
  CHECK(proofs > 0);
}

TEST_CASE("start and goal far beyond all obstacles, whose oblique planes meet far out, too") {
  for (unsigned seed = 0; seed < nef::test::fewer(25); ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Scene scene = random_scene(random);
    const Problem problem(scene);
    for (const int span : {9, 100, 1000000}) {
      const Rational3 a = random.point(span);
      const Rational3 b = random.point(span);
      const Answer answer = problem.solve(a, b, {});
      if (find_collision(scene, a) || find_collision(scene, b)) continue;
      REQUIRE(answer.status == Answer::Status::kPath);
      CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, false) == "");
      PathOptions raw;
      raw.raw = true;
      CHECK(problem.solve(a, b, raw).status == Answer::Status::kPath);
    }
  }
}

}  // namespace
}  // namespace nef::planner::test
