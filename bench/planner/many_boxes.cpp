// SPDX-License-Identifier: Apache-2.0
//
// A large scene: random boxes (200 unless told otherwise) and an L-shaped robot. Time per phase, and the
// cost of state and motion checks in a free space of that size.
//
//   bench_planner_many_boxes [boxes] [seed] [changes] [tight]
//
// With the number of changes given, only these are timed. With a fourth argument the start is in a room whose door is
// exactly as wide as the robot.
#include <ompl/util/Console.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <utility>

#include "apps/planner/command/report.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/translation_planning.h"
#include "apps/planner/partition/segment_walk.h"
#include "apps/planner/path/question.h"
#include "bench/planner/timed_checks.h"

namespace nef::planner {
namespace {

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

// Four walls, floor and ceiling around the start.
Polyhedron tight_room() {
  const Rational half(1, 2);
  const Polyhedron walls =
      subtract(make_box({-8, -8, -8}, {half, half, half}), make_box({-7, -7, -7}, {-half, -half, -half}));
  return closure(subtract(walls, make_box({-half, -4, -4}, {half, -3, -2})));
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
  ProcessStopwatch watch;
  for (int round = 0; round < kRounds; ++round) {
    for (const ExactPoint& point : points) valid += free.is_free(point) ? 1 : 0;
  }
  const double state = watch.lap() / checks;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      walk_segment(free.tree(), points[i], points[i + 1],
                   [&](const SegmentPart& part) { return free.is_free(part.cell); });
    }
  }
  const double motion = watch.lap() / checks;
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
    ProcessStopwatch watch;
    Polyhedron set = free_positions_after({std::nullopt, box}, scene, problem.free_space().set());
    const double positions = 1e3 * watch.lap();
    const FreeSpace free(std::move(set));
    const double cells = 1e3 * watch.lap();
    find_path(free, *scene.start, *scene.goal, options);
    const double path = 1e3 * watch.lap();
    sums[0] += positions;
    sums[1] += cells;
    sums[2] += path;
    longest = std::max(longest, positions + cells + path);
  }
  for (double& sum : sums) sum /= changes;
  std::printf("one box more: free positions %.1f ms, cells %.1f ms, path %.1f ms, together %.1f ms, at most %.1f ms\n",
              sums[0], sums[1], sums[2], sums[0] + sums[1] + sums[2], longest);
}

// A box of side 1 to 4 around the middle of one of the way's longer segments.
Polyhedron box_on(const std::vector<Rational3>& way, std::mt19937& random) {
  std::vector<std::size_t> longer;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    if (distance(way[i], way[i + 1]) > 8) longer.push_back(i);
  }
  const std::size_t i = longer[random() % longer.size()];
  Rational3 low;
  Rational3 high;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational middle(static_cast<long>(std::floor(8 * nearest_double(way[i][k] + way[i + 1][k]))), 16);
    const Rational half(1 + static_cast<long>(random() % 4), 2);
    low[k] = middle - half;
    high[k] = middle + half;
    low[k].canonicalize();
    high[k].canonicalize();
  }
  return make_box(low, high);
}

// What a kind of change and the question after it take.
struct ChangeTime {
  double sum = 0;
  double longest = 0;
  int count = 0;
  int roadmaps = 0;
  int paths = 0;

  // Asks the question; the watch has run since the change began.
  void ask(TranslationPlanning& setup, const ProcessStopwatch& watch) {
    setup.clear();
    setup.solve(60.0);
    const double passed = 1e3 * watch.seconds();
    sum += passed;
    longest = std::max(longest, passed);
    ++count;
    if (setup.getFreeSpace()->has_roadmap()) ++roadmaps;
    if (setup.haveExactSolutionPath()) ++paths;
  }
  void print(const char* what) const {
    std::printf("%-34s %.1f ms, at most %.1f; %d paths, %d roadmaps of %d\n", what, sum / count, longest, paths,
                roadmaps, count);
  }
};

// The same as users of OMPL do it: each change, then a question with default options.
void time_planning(const Problem& problem, int changes) {
  TranslationPlanning setup(problem);
  std::mt19937 random(5);
  ChangeTime beside;
  ChangeTime gone;
  ChangeTime on_way;
  ChangeTime moved;
  ChangeTime old_gone;
  setup.solve(60.0);
  const std::vector<Rational3> way = setup.getTightPlanner()->getExactPath()->points;
  const auto last = [&] { return setup.getScene().obstacles.size() - 1; };
  for (int i = 0; i < changes; ++i) {
    const Polyhedron box = further_box(random);
    ProcessStopwatch watch;
    setup.addObstacle(box);
    beside.ask(setup, watch);
    watch = {};
    setup.removeObstacle(last());
    gone.ask(setup, watch);
    const Polyhedron blocking = box_on(way, random);
    watch = {};
    setup.addObstacle(blocking);
    on_way.ask(setup, watch);
    watch = {};
    setup.removeObstacle(last());
    gone.ask(setup, watch);
    const std::size_t old = random() % last();
    const Polyhedron taken = setup.getScene().obstacles[old];
    watch = {};
    setup.removeObstacle(old);
    old_gone.ask(setup, watch);
    setup.addObstacle(taken);
    setup.clear();
    setup.solve(60.0);
    const Rational3 by{Rational(static_cast<int>(random() % 33) - 16, 8), 1, -1};
    watch = {};
    setup.moveObstacle(random() % last(), by);
    moved.ask(setup, watch);
  }
  std::printf("TranslationPlanning, a change and a question:\n");
  beside.print("a box comes near the diagonal");
  on_way.print("a box comes on the way");
  gone.print("it goes again");
  old_gone.print("another one goes");
  moved.print("one moves");
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
  const Stopwatch watch;
  setup.solve(2.0);
  const double wall = watch.seconds();
  std::printf("%-12s %s in %.4f s, %.0f %% of it in checks\n", name,
              setup.haveExactSolutionPath() ? "solved" : "no path", wall, 100 * checks.seconds / wall);
}

int run(int argc, char** argv) {
  const int boxes = argc > 1 ? std::atoi(argv[1]) : 200;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ProcessStopwatch watch;
  Scene scene = scene_of(boxes, seed);
  if (argc > 4) {
    scene.obstacles.push_back(tight_room());
    scene.obstacle_names.emplace_back("room");
  }
  const Problem problem(std::move(scene));
  const FreeSpace& free = problem.free_space();
  PathOptions options;
  options.thorough = false;
  const Answer answer = problem.solve(options);
  const double processor_all = watch.seconds();
  std::printf("%d boxes: %s, length %.4f\n", boxes, status_name(answer.status),
              answer.path ? answer.path->length : 0.0);
  for (const auto& [phase, seconds] : answer.phases) std::printf("  %-20s %.3f s\n", phase.c_str(), seconds);
  std::printf("%zu cells, %zu components, %zu tight passages\n", free.cells().size(), free.components().size(),
              free.passages().size());
  std::printf("%.3f processor seconds from the boxes to the path\n", processor_all);
  const int changes = argc > 3 ? std::atoi(argv[3]) : 20;
  time_changes(problem, changes);
  time_planning(problem, changes);
  if (argc > 3) return 0;
  watch = {};
  free.build_roadmap();
  std::printf("a roadmap %.1f ms: %zu leaves, %zu portals\n", 1e3 * watch.seconds(), free.tree().leaves().size(),
              free.roadmap().portals().size());
  time_checks(free);
  for (const char* name : {"RRTConnect", "PRM", "EST"}) share_of_checks(problem, name);
  return 0;
}

}  // namespace
}  // namespace nef::planner

int main(int argc, char** argv) { return nef::planner::run(argc, argv); }
