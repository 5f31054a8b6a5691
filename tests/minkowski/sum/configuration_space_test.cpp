// SPDX-License-Identifier: Apache-2.0
//
// Free spaces of translating robots: contact is free, so passages of no width remain.
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/sum/fixed_obstacles.h"
#include "nef/construct/convex_hull.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/minkowski_shapes.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::configuration_space;
using nef::test::set;

const std::optional<std::array<Rational3, 2>> kBox = {
    {Rational3{Rational(-10), Rational(-10), Rational(-10)}, Rational3{Rational(10), Rational(10), Rational(10)}}};

// What of the free space is not in the closure of its inside.
Polyhedron tight(const Polyhedron& free) { return nef::subtract(free, nef::regularize(free)); }

Polyhedron free_space(const std::string& robot, const std::vector<std::string>& obstacles) {
  std::vector<Polyhedron> sets;
  for (const std::string& text : obstacles) sets.push_back(set(text));
  return nef::test::valid(configuration_space(set(robot), sets, kBox), "free space");
}

TEST_CASE("a slot as wide as the robot leaves a facet") {
  const Polyhedron free = free_space("box(0,0,0,1,1,1)", {"box(-20,-20,0,-1,20,2)", "box(0,-20,0,20,20,2)"});
  CHECK(free.is_closed());
  // The robot's corner runs in x = -1 while its top is above 0 and its bottom below 2.
  CHECK(nef::equal(nef::closure(tight(free)), set("polygon(-1,-10,-1, -1,10,-1, -1,10,2, -1,-10,2)")));
}

TEST_CASE("a hole as wide as the robot leaves an edge, a cavity of its size a vertex") {
  const Polyhedron hole = free_space("box(0,0,0,1,1,1)", {"box(-20,-20,0,20,20,2) - interior(box(0,0,-1,1,1,3))"});
  CHECK(nef::equal(nef::closure(tight(hole)), set("segment(0,0,-1, 0,0,2)")));
  const Polyhedron cavity = free_space("box(0,0,0,1,1,1)", {"box(-5,-5,-5,5,5,5) - interior(box(2,2,2,3,3,3))"});
  CHECK(nef::equal(tight(cavity), set("point(2,2,2)")));
}

TEST_CASE("narrower by any amount, the passage is gone, wider, it is solid") {
  const Polyhedron narrow =
      free_space("box(0,0,0,1,1,1)", {"box(-20,-20,0,-1,20,2)", "box(-1/1000000000,-20,0,20,20,2)"});
  CHECK(tight(narrow).is_empty());
  CHECK_FALSE(nef::contains(narrow, {Rational(-1), Rational(0), Rational(1, 2)}));
  const Polyhedron wide = free_space("box(0,0,0,1,1,1)", {"box(-20,-20,0,-1,20,2)", "box(1/1000000000,-20,0,20,20,2)"});
  CHECK(tight(wide).is_empty());
  CHECK(nef::contains(wide, {Rational(-1), Rational(0), Rational(1, 2)}));
}

TEST_CASE("a point robot: walls of abutting boxes are no passage") {
  const std::vector<std::string> boxes = {"box(-1,-1,-1,0,1,1)", "box(0,-1,-1,1,1,1)"};
  const Polyhedron free = free_space("point(0,0,0)", boxes);
  CHECK_FALSE(nef::contains(free, {Rational(0), Rational(0), Rational(0)}));
  CHECK(nef::equal(free, set("box(-10,-10,-10,10,10,10) - interior(box(-1,-1,-1,1,1,1))")));
  // An obstacle that needs walls to be cut into convex cells must not let a point through them either.
  const Polyhedron bent = free_space("point(0,0,0)", {"box(0,0,0,3,1,1) + box(0,0,0,1,3,1)"});
  CHECK(nef::equal(bent, set("box(-10,-10,-10,10,10,10) - interior(box(0,0,0,3,1,1) + box(0,0,0,1,3,1))")));
}

TEST_CASE("segments and facets as robots slide on obstacles but do not enter them") {
  const Polyhedron along = free_space("segment(0,0,0,1,0,0)", {"box(0,0,0,2,2,2)", "box(0,2,0,2,4,2)"});
  CHECK(nef::equal(along, set("box(-10,-10,-10,10,10,10) - interior(box(-1,0,0,2,4,2))")));
  const Polyhedron plate = free_space("polygon(0,0,0, 1,0,0, 1,1,0, 0,1,0)", {"box(0,0,0,2,2,2)"});
  CHECK(nef::equal(plate, set("box(-10,-10,-10,10,10,10) - interior(box(-1,-1,0,2,2,2))")));
}

TEST_CASE("flat obstacles block the inside of a solid robot") {
  const Polyhedron sheet = free_space("box(0,0,0,1,1,1)", {"polygon(0,0,0, 2,0,0, 2,2,0, 0,2,0)"});
  CHECK(nef::equal(sheet, set("box(-10,-10,-10,10,10,10) - interior(box(-1,-1,-1,2,2,0))")));
  const Polyhedron needle = free_space("box(0,0,0,1,1,1)", {"point(0,0,0)"});
  CHECK(nef::equal(needle, set("box(-10,-10,-10,10,10,10) - interior(box(-1,-1,-1,0,0,0))")));
}

TEST_CASE("the definition: a position is free iff the open robot misses the closed obstacles") {
  const std::string robot = "box(0,0,0,2,1,1) + box(0,0,0,1,2,1)";
  const std::string obstacle = "box(0,0,0,5,5,3) - interior(box(1,1,-1,4,3,4)) - interior(box(2,2,-1,4,4,4))";
  const Polyhedron free = free_space(robot, {obstacle});
  const Polyhedron open_robot = nef::interior(set(robot));
  const Polyhedron closed = set(obstacle);
  for (int x = 0; x <= 8; ++x) {
    for (int y = 0; y <= 8; ++y) {
      const Rational3 at = {Rational(x, 2), Rational(y, 2), Rational(1, 3)};
      const bool misses = nef::intersect(nef::transform(open_robot, nef::AffineMap::translate(at)), closed).is_empty();
      CAPTURE(x, y);
      CHECK(nef::contains(free, at) == misses);
    }
  }
}

TEST_CASE("no obstacles, no box, a robot that is nothing is refused, one without end is not") {
  CHECK(configuration_space(set("box(0,0,0,1,1,1)"), {}).is_everything());
  CHECK(nef::equal(free_space("box(0,0,0,1,1,1)", {}), set("box(-10,-10,-10,10,10,10)")));
  CHECK_THROWS_AS(configuration_space(Polyhedron(), {}), nef::InputError);
  CHECK(configuration_space(set("halfspace(1,0,0,0)"), {}).is_everything());
}

TEST_CASE("obstacles without end") {
  const std::vector<Polyhedron> wall = {set("interior(halfspace(1,0,0,0))")};
  CHECK(nef::equal(configuration_space(set("box(0,0,0,1,1,1)"), wall), set("halfspace(-1,0,0,0)")));
  // Between two walls there is just room for the robot.
  const std::vector<Polyhedron> walls = {set("halfspace(1,0,0,0)"), set("halfspace(-1,0,0,1)")};
  CHECK(nef::equal(configuration_space(set("box(0,0,0,1,1,1)"), walls), set("boundary(halfspace(1,0,0,0))")));
  CHECK(nef::equal(configuration_space(set("point(0,0,0)"), walls), set("halfspace(-1,0,0,0) * halfspace(1,0,0,-1)")));
}

TEST_CASE("obstacles cut up once: the same free spaces for any robot of convex pieces") {
  const std::vector<std::vector<std::string>> obstacle_lists = {
      {},
      {"box(0,0,0,5,5,3) - interior(box(1,1,-1,4,3,4)) - interior(box(2,2,-1,4,4,4))", "box(-4,-4,0,-2,-2,1)"},
      {"box(-4,-4,-4,4,4,4) - interior(box(-4,-1,-2,3,2,2))", "box(20,0,0,30,1,1)"},  // a wall remains at -4
      {"box(0,0,0,1,1,1) + polygon(1,0,0, 4,0,0, 4,3,0, 1,3,0) + segment(0,0,1, 0,0,4)", "point(-3,0,0)"}};
  using Box = std::array<Rational3, 2>;
  const std::vector<std::vector<Box>> robots = {
      {},
      {Box{Rational3{0, 0, 0}, Rational3{1, 2, 1}}},
      {Box{Rational3{0, 0, 0}, Rational3{2, 1, 1}}, Box{Rational3{0, 1, 0}, Rational3{1, 3, 1}},
       Box{Rational3{1, 1, -1}, Rational3{2, 2, 2}}}};
  for (const std::vector<std::string>& list : obstacle_lists) {
    std::vector<Polyhedron> obstacles;
    for (const std::string& text : list) obstacles.push_back(set(text));
    for (const std::vector<Box>& boxes : robots) {
      std::vector<nef::Mesh> pieces;
      std::vector<Polyhedron> parts;
      for (const auto& [low, high] : boxes) {
        parts.push_back(nef::make_box(low, high));
        std::vector<Rational3> corners;
        for (std::size_t k = 0; k < 8; ++k) {
          corners.push_back(
              {(k & 1U) != 0 ? high[0] : low[0], (k & 2U) != 0 ? high[1] : low[1], (k & 4U) != 0 ? high[2] : low[2]});
        }
        pieces.push_back(nef::convex_hull_mesh(corners));
      }
      const Polyhedron robot = nef::unite_all(parts);
      for (const bool bounded : {false, true}) {
        const auto box = bounded ? kBox : std::nullopt;
        const Polyhedron all = bounded ? nef::make_box((*kBox)[0], (*kBox)[1]) : Polyhedron::everything();
        const auto free = [&](bool may_touch) {
          const nef::minkowski::FixedObstacles fixed(obstacles, box, may_touch, {});
          return nef::test::valid(fixed.free_positions(pieces, {}), "free space");
        };
        CHECK(nef::equal(free(true), boxes.empty() ? all : configuration_space(robot, obstacles, box)));
        const Polyhedron touched =
            nef::minkowski::minkowski_sum(nef::unite_all(obstacles), nef::minkowski::negate(robot));
        CHECK(nef::equal(free(false), nef::subtract(all, touched)));
      }
    }
  }
}

TEST_CASE("free spaces are the same with cells and without") {
  nef::test::check("free space", 60, [] {
    const Polyhedron robot = (*nef::test::recipes(true, 3, 2)).make();
    const std::vector<Polyhedron> obstacles = {(*nef::test::recipes(true, 4)).make(),
                                               nef::regularize((*nef::test::recipes(true, 3)).make()),
                                               set("box(7,0,0,9,1,1)")};
    RC_PRE(!robot.is_empty());
    nef::minkowski::MinkowskiOptions options;
    options.strategy = nef::minkowski::UnionStrategy::kQueue;
    const Polyhedron by_cells = configuration_space(robot, obstacles, kBox, options);
    RC_ASSERT(nef::equal(configuration_space(robot, obstacles, kBox), by_cells));
    options.strategy = nef::minkowski::UnionStrategy::kConvolution;
    RC_ASSERT(nef::equal(configuration_space(robot, obstacles, kBox, options), by_cells));
  });
}

TEST_CASE("which obstacles are summed without cells") {
  const std::vector<Polyhedron> obstacles = {nef::from_mesh(nef::test::mushroom()), set("box(7,0,0,9,1,1)"),
                                             set("box(10,0,0,13,1,1) + box(10,0,0,11,3,1)")};
  const Polyhedron robot = set("box(0,0,0,4,1,1) + box(0,0,0,1,4,1) + box(0,0,0,1,1,4) + box(3,0,0,4,1,4)");
  nef::minkowski::MinkowskiReport report;
  const Polyhedron free = configuration_space(robot, obstacles, kBox, {}, &report);
  REQUIRE(report.choices.size() == 2);
  CHECK(report.choices[0].chosen == "convolution");
  CHECK(report.choices[1].why.find("obstacles are convex, have few cells, or are not solid") == 0);
  CHECK(report.cells_a == 3);
  nef::minkowski::MinkowskiOptions queue;
  queue.strategy = nef::minkowski::UnionStrategy::kQueue;
  CHECK(nef::equal(configuration_space(robot, obstacles, kBox, queue), free));
}

}  // namespace
