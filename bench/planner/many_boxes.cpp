// SPDX-License-Identifier: Apache-2.0
//
// A large scene: random boxes (200 unless told otherwise) and an L-shaped robot. Time per phase, and the
// cost of state and motion checks in a free space of that size.
//
//   bench_planner_many_boxes [boxes] [seed]
#include <ompl/util/Console.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "apps/planner/command/report.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/translation_planning.h"
#include "apps/planner/partition/segment_walk.h"
#include "apps/planner/path/question.h"
#include "bench/planner/timed_checks.h"

namespace {

using namespace nef;           // NOLINT(google-build-using-namespace): this is the program
using namespace nef::planner;  // NOLINT(google-build-using-namespace)

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
  constexpr int kRounds = 20;
  const double checks = kRounds * static_cast<double>(points.size());
  std::size_t valid = 0;
  double begin = processor();
  for (int round = 0; round < kRounds; ++round) {
    for (const ExactPoint& point : points) valid += free.is_free(point) ? 1 : 0;
  }
  const double state = (processor() - begin) / checks;
  begin = processor();
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      walk_segment(free.tree(), points[i], points[i + 1],
                   [&](const SegmentPart& part) { return free.is_free(part.cell); });
    }
  }
  const double motion = (processor() - begin) / checks;
  std::printf("state check %.3f us, motion check between random states %.3f us; %zu of %zu states free\n", 1e6 * state,
              1e6 * motion, valid / kRounds, points.size());
}

// One box more, and the same question again.
void time_change(const Problem& problem) {
  const Scene& scene = problem.scene();
  double begin = processor();
  const auto lap = [&begin] {
    const double passed = processor() - begin;
    begin += passed;
    return 1e3 * passed;
  };
  Polyhedron set = with_obstacle(scene, problem.free_space().set(), make_box({14, 14, 14}, {16, 17, 15}));
  const double positions = lap();
  const FreeSpace free(std::move(set));
  const double cells = lap();
  PathOptions options;
  options.thorough = false;
  const bool found = find_path(free, *scene.start, *scene.goal, options).has_value();
  const double path = lap();
  const double all = positions + cells + path;
  free.build_roadmap();
  std::printf("one box more: free positions %.1f ms, cells %.1f ms, %s %.1f ms, together %.1f ms; a roadmap %.1f ms\n",
              positions, cells, found ? "path" : "no path", path, all, lap());
}

// How much of a stock planner's time its checks take in this scene.
void share_of_checks(const Problem& problem, const char* name) {
  TranslationPlanning setup(problem);
  const ompl::base::SpaceInformationPtr& si = setup.getSpaceInformation();
  CheckTime checks;
  setup.setStateValidityChecker(std::make_shared<TimedState>(si, problem.shared_free_space(), checks));
  si->setMotionValidator(std::make_shared<TimedMotion>(si, problem.shared_free_space(), checks));
  setup.setPlanner(make_ompl_planner(name, si));
  setup.setup();
  const double begin = now();
  setup.solve(2.0);
  const double wall = now() - begin;
  std::printf("%-12s %s in %.4f s, %.0f %% of it in checks\n", name,
              setup.haveExactSolutionPath() ? "solved" : "no path", wall, 100 * checks.seconds / wall);
}

}  // namespace

int main(int argc, char** argv) {
  const int boxes = argc > 1 ? std::atoi(argv[1]) : 200;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const double begin = processor();
  const Problem problem(scene_of(boxes, seed));
  const FreeSpace& free = problem.free_space();
  PathOptions options;
  options.thorough = false;
  const Answer answer = problem.solve(options);
  const double processor_all = processor() - begin;
  std::printf("%d boxes: %s, length %.4f\n", boxes, status_name(answer.status).c_str(),
              answer.path ? answer.path->length : 0.0);
  for (const auto& [phase, seconds] : answer.phases) std::printf("  %-20s %.3f s\n", phase.c_str(), seconds);
  std::printf("%zu cells, %zu leaves, %zu stations, %zu components, %zu tight passages\n", free.cells().size(),
              free.tree().leaves().size(), free.zones().stations().size(), free.components().size(),
              free.passages().size());
  std::printf("%.3f processor seconds from the boxes to the path\n", processor_all);
  time_change(problem);
  time_checks(free);
  for (const char* name : {"RRTConnect", "PRM", "EST"}) share_of_checks(problem, name);
  return 0;
}
