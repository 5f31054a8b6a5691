// SPDX-License-Identifier: Apache-2.0
//
// A large scene: random boxes (200 unless told otherwise) and an L-shaped robot. Time per phase, and the
// cost of state and motion checks in a free space of that size.
//
//   bench_planner_many_boxes [boxes] [seed] [changes]
//
// With the number of changes given, only these are timed.
#include <ompl/util/Console.h>

#include <algorithm>
#include <array>
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

// Boxes of side 1 to 2 near the diagonal, where ways are.
Polyhedron further_box(std::mt19937& random) {
  std::uniform_int_distribution<int> place(16, 480);
  std::uniform_int_distribution<int> off(-32, 32);
  const int along = place(random);
  const auto number = [](int sixteenths) {
    Rational value(sixteenths, 16);
    value.canonicalize();
    return value;
  };
  const std::array<int, 3> low{along + off(random), along + off(random), along + off(random)};
  return make_box({number(low[0]), number(low[1]), number(low[2])},
                  {number(low[0] + 32), number(low[1] + 24), number(low[2] + 16)});
}

// One box more, and the same question again: what each part of that takes, from the same scene with one of several
// boxes.
void time_changes(const Problem& problem, int changes) {
  const Scene& scene = problem.scene();
  std::mt19937 random(5);
  PathOptions options;
  options.thorough = false;
  std::array<double, 3> sums{};
  double longest = 0;
  for (int i = 0; i < changes; ++i) {
    const Polyhedron box = further_box(random);
    double begin = processor();
    const auto lap = [&begin] {
      const double passed = processor() - begin;
      begin += passed;
      return 1e3 * passed;
    };
    Polyhedron set = with_obstacle(scene, problem.free_space().set(), box);
    const double positions = lap();
    const FreeSpace free(std::move(set));
    const double cells = lap();
    find_path(free, *scene.start, *scene.goal, options);
    const double path = lap();
    sums[0] += positions;
    sums[1] += cells;
    sums[2] += path;
    longest = std::max(longest, positions + cells + path);
  }
  for (double& sum : sums) sum /= changes;
  std::printf("one box more: free positions %.1f ms, cells %.1f ms, path %.1f ms, together %.1f ms, at most %.1f ms\n",
              sums[0], sums[1], sums[2], sums[0] + sums[1] + sums[2], longest);
}

// The same as users of OMPL do it: a box comes, a question, it goes, a question.
void time_planning(const Problem& problem, int changes) {
  TranslationPlanning setup(problem);
  std::mt19937 random(5);
  std::array<double, 2> sums{};
  std::array<double, 2> longest{};
  const auto ask = [&](std::size_t which, double begin) {
    setup.clear();
    setup.solve(60.0);
    const double passed = 1e3 * (processor() - begin);
    sums[which] += passed / changes;
    longest[which] = std::max(longest[which], passed);
    if (getenv("DBG"))
      std::printf("%zu %.1f roadmap %.1f status %s len %g\n", which, passed,
                  1e3 * setup.getFreeSpace()->roadmap_seconds(), setup.getLastPlannerStatus().asString().c_str(),
                  setup.haveSolutionPath() ? setup.getSolutionPath().length() : 0.0);
  };
  setup.solve(60.0);
  for (int i = 0; i < changes; ++i) {
    const Polyhedron box = further_box(random);
    double begin = processor();
    setup.addObstacle(box);
    ask(0, begin);
    begin = processor();
    setup.removeObstacle(setup.getScene().obstacles.size() - 1);
    ask(1, begin);
  }
  std::printf(
      "TranslationPlanning: a box comes, and a question %.1f ms, at most %.1f; it goes, and a question %.1f ms, "
      "at most %.1f\n",
      sums[0], longest[0], sums[1], longest[1]);
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
  std::printf("%zu cells, %zu components, %zu tight passages\n", free.cells().size(), free.components().size(),
              free.passages().size());
  std::printf("%.3f processor seconds from the boxes to the path\n", processor_all);
  const int changes = argc > 3 ? std::atoi(argv[3]) : 20;
  time_changes(problem, changes);
  time_planning(problem, changes);
  if (argc > 3) return 0;
  const double before_roadmap = processor();
  free.build_roadmap();
  std::printf("a roadmap %.1f ms: %zu leaves, %zu stations\n", 1e3 * (processor() - before_roadmap),
              free.tree().leaves().size(), free.zones().stations().size());
  time_checks(free);
  for (const char* name : {"RRTConnect", "PRM", "EST"}) share_of_checks(problem, name);
  return 0;
}
