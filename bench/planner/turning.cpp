// SPDX-License-Identifier: Apache-2.0
//
// Robots that turn about the vertical: cells of angles and processor seconds until the answer, for scenes whose answer
// is known (a bar round the corner of a corridor, a bar and a slot that fits it at one angle, a dumbbell before a slot)
// and for dense scenes of turned obstacles.
//
//   bench_planner_turning [dense scenes] [first seed]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>

#include "apps/planner/turning/turning_collision.h"
#include "apps/planner/turning/turning_search.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

struct Question {
  Scene scene;
  TurningQuestion turning;
};

void add(Scene& scene, const Polyhedron& obstacle) {
  scene.obstacles.push_back(obstacle);
  scene.obstacle_names.emplace_back("obstacle");
}

// Two corridors of width 2, the bar is 1 wide. Its limit at 45 degrees: 4 sqrt 2 - 2.
Question corner(const Rational& margin) {
  Question q;
  const Rational length = exact_rational(4 * std::sqrt(2) - 2) * (1 - margin);
  q.scene.robot = make_box({-length / 2, Rational(-1, 2), 0}, {length / 2, Rational(1, 2), 1});
  const Polyhedron corridors =
      unite(interior(make_box({-21, -2, -2}, {0, 0, 3})), interior(make_box({-2, -2, -2}, {0, 21, 3})));
  add(q.scene, subtract(make_box({-20, -20, -1}, {20, 20, 2}), corridors));
  q.scene.box = {Rational3{-15, -15, 0}, Rational3{15, 15, 0}};
  q.turning.high = 1;
  q.turning.start = {{-12, -1, 0}, 0};
  q.turning.goal = {{-1, 12, 0}, 1};
  return q;
}

// A slot through a block, turned by the angle of 3-4-5, and a bar as wide as that but for `excess`. Full circle.
Question slot(const Rational& excess) {
  Question q;
  q.scene.robot = make_box({-1, Rational(-1, 2), 0}, {1, Rational(1, 2), 1});
  const Rational half = (1 + excess) / 2;
  const Polyhedron block =
      subtract(make_box({0, -30, -1}, {4, 30, 2}), interior(make_box({-1, -half, -2}, {5, half, 3})));
  AffineMap turn = AffineMap::identity();
  turn.linear[0][0] = turn.linear[1][1] = Rational(4, 5);
  turn.linear[1][0] = Rational(3, 5);
  turn.linear[0][1] = Rational(-3, 5);
  add(q.scene, transform(block, turn));
  q.scene.box = {Rational3{-9, -9, 0}, Rational3{9, 9, 0}};
  q.turning.start = {{-4, -3, 0}, 0};
  q.turning.goal = {{8, 6, 0}, 0};
  return q;
}

// Two squares of side 1 with a bar between them, before a slot in a wall that is `excess` wider. Full circle.
Question dumbbell(const Rational& excess) {
  Question q;
  const Rational half(1, 2);
  q.scene.robot =
      unite_all(std::vector<Polyhedron>{make_box({-2, -half, 0}, {-1, half, 1}), make_box({1, -half, 0}, {2, half, 1}),
                                        make_box({-1, Rational(-1, 8), 0}, {1, Rational(1, 8), 1})});
  const Rational gap = (1 + excess) / 2;
  add(q.scene, make_box({0, -20, -1}, {1, -gap, 2}));
  add(q.scene, make_box({0, gap, -1}, {1, 20, 2}));
  q.scene.box = {Rational3{-6, -6, 0}, Rational3{6, 6, 0}};
  q.turning.start = {{-4, 0, 0}, 0};
  q.turning.goal = {{4, 0, 0}, 0};
  return q;
}

// 40 obstacles, turned by angles of Pythagorean triangles, in a square of side 12; every second scene has heights, too.
// Start and goal are free, at the left and at the right.
Question dense(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](int low, int high) {
    Rational value(std::uniform_int_distribution<int>(low, high)(random), 8);
    value.canonicalize();
    return value;
  };
  constexpr int kSide = 12;
  const bool has_heights = seed % 2 == 1;
  Question q;
  const Polyhedron bar = make_box({Rational(-3, 2), Rational(-1, 4), 0}, {Rational(3, 2), Rational(1, 4), 1});
  q.scene.robot = seed % 3 == 2 ? unite(bar, make_box({Rational(1, 2), Rational(-1, 4), 0}, {1, 1, 1})) : bar;
  const Rational top = has_heights ? 3 : 0;
  q.scene.box = {Rational3{0, 0, 0}, Rational3{kSide, kSide, top}};
  for (int i = 0; i < 40; ++i) {
    const Rational t = number(0, 8);  // half the angle's tangent
    const Rational square = 1 + t * t;
    AffineMap map = AffineMap::identity();
    map.linear[0][0] = map.linear[1][1] = (1 - t * t) / square;
    map.linear[1][0] = 2 * t / square;
    map.linear[0][1] = -map.linear[1][0];
    const Rational3 at{number(0, 8 * kSide), number(0, 8 * kSide), 0};
    for (std::size_t k = 0; k < 2; ++k) map.translation[k] = at[k];
    const Rational low = has_heights ? number(-8, 16) : Rational(-1);
    const Rational high = has_heights ? low + number(8, 24) : Rational(2);
    add(q.scene, transform(make_box({0, 0, low}, {number(6, 20), number(3, 10), high}), map));
  }
  const TurningCollision collision(q.scene, q.turning.axis);
  const auto free_pose = [&](int low, int high) {
    Pose pose;
    do {
      pose = {{number(8 * low, 8 * high), number(0, 8 * kSide), has_heights ? number(0, 24) : Rational(0)},
              number(0, 31)};
    } while (!collision.is_free(pose));
    return pose;
  };
  q.turning.start = free_pose(0, 3);
  q.turning.goal = free_pose(kSide - 3, kSide);
  return q;
}

// Returns the seconds.
double tell(const char* name, const Question& q, std::size_t max_cells = 2000) {
  const ProcessStopwatch watch;
  const TurningAnswer answer = find_turning_path(q.scene, q.turning, {.max_cells = max_cells});
  const double seconds = watch.seconds();
  static constexpr const char* kNames[] = {"path", "infeasible", "undecided", "invalid start", "invalid goal"};
  std::printf("%-26s %-11s %4zu cells, %3zu looked at, %6.2f s\n", name,
              kNames[static_cast<std::size_t>(answer.status)], answer.cells, answer.looked_at, seconds);
  std::fflush(stdout);
  return seconds;
}

int run(int argc, char** argv) {
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 12;
  const auto first = static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 0);
  const auto power = [](int digits) { return Rational(1, static_cast<unsigned long>(std::pow(10, digits))); };
  tell("corner, margin 1 %", corner(power(2)));
  tell("corner, margin 0.1 %", corner(power(3)));
  tell("corner, margin -0.1 %", corner(-power(3)));
  tell("slot 3-4-5, no margin", slot(0));
  tell("slot 3-4-5, 1e-9 wider", slot(power(9)));
  tell("slot 3-4-5, 1e-9 narrower", slot(-power(9)));
  tell("dumbbell, 10 % too wide", dumbbell(-power(1)));
  tell("dumbbell, 1 % too wide", dumbbell(-power(2)));
  double most = 0;
  for (int i = 0; i < scenes; ++i) {
    const unsigned seed = first + static_cast<unsigned>(i);
    most = std::max(most, tell(("dense, seed " + std::to_string(seed)).c_str(), dense(seed)));
  }
  std::printf("the longest of %d dense scenes: %.2f s\n", scenes, most);
  return 0;
}

}  // namespace
}  // namespace nef::planner

int main(int argc, char** argv) { return nef::planner::run(argc, argv); }
