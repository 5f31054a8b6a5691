// SPDX-License-Identifier: Apache-2.0
//
// A large scene: random boxes (200 unless told otherwise) and an L-shaped robot. Time per phase, and the
// cost of state and motion checks in a free space of that size.
//
//   bench_planner_many_boxes [boxes] [seed]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "apps/planner/question.h"
#include "apps/planner/segment_walk.h"

namespace {

using namespace nef;           // NOLINT(google-build-using-namespace): this is the program
using namespace nef::planner;  // NOLINT(google-build-using-namespace)

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Scene scene_of(int boxes, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](int low, int high) {
    Rational value(std::uniform_int_distribution<int>(low, high)(random), 16);
    value.canonicalize();
    return value;
  };
  Scene scene;
  scene.name = "many boxes";
  scene.robot = unite(make_box({0, 0, 0}, {2, 1, 1}), make_box({0, 0, 0}, {1, 1, 2}));
  for (int i = 0; i < boxes; ++i) {
    Rational3 low{number(16, 480), number(16, 480), number(16, 480)};
    const Rational3 high{low[0] + number(16, 64), low[1] + number(16, 64), low[2] + number(16, 64)};
    scene.obstacles.push_back(make_box(low, high));
    scene.obstacle_names.emplace_back("box");
  }
  scene.start = Rational3{-3, -3, -3};
  scene.goal = Rational3{37, 36, 35};
  return scene;
}

void time_checks(const FreeSpace& free) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 32);
  std::vector<ExactPoint> points;
  for (int i = 0; i < 2000; ++i) {
    points.emplace_back(std::array<double, 3>{coordinate(random), coordinate(random), coordinate(random)});
  }
  std::size_t valid = 0;
  double begin = now();
  for (const ExactPoint& point : points) valid += free.is_free(point) ? 1 : 0;
  const double state = (now() - begin) / static_cast<double>(points.size());
  begin = now();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    walk_segment(free.tree(), points[i], points[i + 1],
                 [&](const SegmentPart& part) { return free.is_free(part.cell); });
  }
  const double motion = (now() - begin) / static_cast<double>(points.size());
  std::printf("state check %.3f us, motion check %.3f us, %zu of %zu states free\n", 1e6 * state, 1e6 * motion, valid,
              points.size());
}

}  // namespace

int main(int argc, char** argv) {
  const int boxes = argc > 1 ? std::atoi(argv[1]) : 200;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const Problem problem(scene_of(boxes, seed));
  const FreeSpace& free = problem.free_space();
  PathOptions options;
  options.thorough = false;
  const Answer answer = problem.solve(options);
  std::printf("%d boxes: %s, length %.4f\n", boxes, status_name(answer.status).c_str(),
              answer.path ? answer.path->length : 0.0);
  for (const auto& [phase, seconds] : answer.phases) std::printf("  %-20s %.3f s\n", phase.c_str(), seconds);
  std::printf("%zu cells, %zu leaves, %zu stations, %zu components, %zu tight passages\n", free.cells().size(),
              free.tree().leaves().size(), free.zones().stations().size(), free.components().size(),
              free.passages().size());
  time_checks(free);
  return 0;
}
