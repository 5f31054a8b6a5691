// SPDX-License-Identifier: Apache-2.0
//
// Paths of robots that turn freely (certified_trees.h, slices.h, slice_search.h, shorten_poses.h): each is checked at
// many exact poses by Booleans of the moved robot, which shares nothing with the search. Ways that surely are there are
// found; what collides is said to.
#include "apps/planner/rigid_search/rigid_planning.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include "apps/planner/free_space/collision.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/orientation/rotations.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid_search/certified_trees.h"
#include "apps/planner/rigid_search/first_true.h"
#include "apps/planner/rigid_search/made_once.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "apps/planner/rigid_search/shorten_poses.h"
#include "apps/planner/rigid_search/slice_search.h"
#include "apps/planner/rigid_search/slices.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/time_limit.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

#ifdef PLANNER_TEST_FCL
#include "bench/planner/fcl_bodies.h"
#endif

namespace nef::planner::test::rigid_planning {
namespace {

using Status = RigidAnswer::Status;

RigidAnswer answer_of(const Scene& scene, const RigidLimits& limits = {}, const Monitor& monitor = {}) {
  return find_rigid_path(scene, MotionChecker::of_scene(scene), limits, monitor);
}

bool in_lowest_terms(const Rational& x) {
  Rational reduced = x;
  reduced.canonicalize();
  return reduced.get_den() == x.get_den();
}

// FCL's verdict in doubles about 2,000 poses of each motion that touches nothing.
void check_by_fcl([[maybe_unused]] const MotionChecker& checker, [[maybe_unused]] const RigidAnswer& answer) {
#ifdef PLANNER_TEST_FCL
  const std::shared_ptr<FclModel> robot = fcl_model_of(checker.robot());
  const std::shared_ptr<FclModel> obstacles = fcl_model_of(checker.obstacles());
  constexpr int kPoses = 2000;
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    if (answer.certified.motions[i].touches) continue;
    const RigidMotion motion(answer.path[i], answer.path[i + 1], MotionTiming::kSlerp);
    int collide = 0;
    for (int k = 0; k <= kPoses; ++k) {
      const RigidPose pose = motion.at(static_cast<double>(k) / kPoses);
      fcl::Transform3d place = fcl::Transform3d::Identity();
      place.linear() = PoseMetric::rounded(pose.quaternion).toRotationMatrix();
      place.translation() = to_vector(pose.position);
      if (fcl_collides(*robot, place, *obstacles)) ++collide;
    }
    CAPTURE(i);
    CHECK(collide == 0);
  }
#endif
}

void check_same_path(const RigidAnswer& answer, const RigidAnswer& expected) {
  REQUIRE(answer.path.size() == expected.path.size());
  for (std::size_t i = 0; i < expected.path.size(); ++i) {
    CHECK(answer.path[i].position == expected.path[i].position);
    CHECK(answer.path[i].quaternion == expected.path[i].quaternion);
  }
}

// The ends are those of the question, the parts are certified, and no pose of some collides.
void check_path(const Scene& scene, const RigidAnswer& answer, std::size_t poses) {
  REQUIRE(answer.status == Status::kPath);
  const RigidQuestion question = rigid_question_of(scene);
  REQUIRE(answer.path.size() >= 2);
  CHECK(answer.path.front().position == question.start.position);
  CHECK(answer.path.front().quaternion == question.start.quaternion);
  CHECK(answer.path.back().position == question.goal.position);
  CHECK(answer.path.back().quaternion == question.goal.quaternion);
  for (const RigidPose& pose : answer.path) {
    CHECK(std::all_of(pose.position.begin(), pose.position.end(), in_lowest_terms));
    CHECK(std::all_of(pose.quaternion.begin(), pose.quaternion.end(), in_lowest_terms));
  }
  const MotionChecker checker = MotionChecker::of_scene(scene);
  CHECK(certify(checker, answer.path).status == MotionVerdict::Status::kFree);
  check_by_fcl(checker, answer);
  const std::size_t motions = answer.path.size() - 1;
  const std::size_t steps = poses / motions + 1;
  for (std::size_t i = 0; i < motions; ++i) {
    const RigidMotion motion(answer.path[i], answer.path[i + 1], MotionTiming::kSlerp);
    for (std::size_t k = 0; k < steps; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(steps);
      const RigidPose pose = motion.at(s);
      // Positions in between are rounded, so poses with contact are left to the checker, which says that they are free.
      if (checker.check(pose).status == MotionVerdict::Status::kFree) {
        CHECK_FALSE(find_collision(scene, pose));
      } else {
        CHECK(answer.certified.motions[i].touches);
      }
    }
  }
}

TEST_CASE("A bar turns round an elbow in x, y and z with .2 % of slack", "[rigid][threads]") {
  const Scene scene = load("rigid/elbow");
  const RigidAnswer answer = answer_of(scene);
  check_path(scene, answer, 60);
  CHECK(answer.slices > 0);
  for (const unsigned threads : {1U, 2U, 5U}) {  // the same in every run
    const RigidAnswer again = answer_of(scene, {}, Monitor().on_threads(threads));
    CHECK(again.samples == answer.samples);
    CHECK(again.slices == answer.slices);
    CHECK(again.boxes == answer.boxes);
    check_same_path(again, answer);
  }
}

TEST_CASE("A search through slices that is out of slices goes on with more, on any number of threads",
          "[rigid][threads]") {
  const Scene scene = load("rigid/elbow");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  std::vector<std::size_t> made;
  for (const unsigned threads : {1U, 2U, 4U}) {
    const Monitor monitor = Monitor().on_threads(threads);
    SliceSearch search(scene, rigid_question_of(scene), checker, monitor);
    for (const std::size_t most : {1, 2, 5, 9, 16}) {
      CHECK_FALSE(search.run(most, monitor));
      made.push_back(search.slices());
    }
    const auto path = search.run(40, monitor);
    REQUIRE(path);
    made.push_back(path->size());
  }
  for (std::size_t i = 6; i < made.size(); ++i) CHECK(made[i] == made[i - 6]);
}

TEST_CASE("Values are made once, by whoever asks first", "[rigid][threads]") {
  MadeOnce<int, int> values;
  CHECK(values.known(3).value == nullptr);
  CHECK_THROWS_AS(values.at(3, []() -> int { throw InputError("not now"); }), InputError);
  CHECK(values.known(3).value == nullptr);
  std::atomic<int> made = 0;
  std::atomic<int> wrong = 0;
  std::atomic<int> meanwhile = 0;
  parallel_for(100, Monitor().on_threads(4), [&](std::size_t i, const Monitor&) {
    const int key = static_cast<int>(i % 5);
    const auto make = [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++made;
      return key * key;
    };
    if (values.at(key, make, [&] { return ++meanwhile < 50; }) != key * key) ++wrong;
  });
  CHECK(wrong == 0);
  CHECK(made == 5);
  REQUIRE(values.known(3).value != nullptr);
  CHECK(*values.known(3).value == 9);
}

TEST_CASE("A bar that is longer than the elbow lets through is not said to pass, nor to be stuck", "[rigid]") {
  Scene scene = load("rigid/elbow");
  scene.robot = transform(scene.robot, AffineMap{{{{Rational(101, 100), 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}});
  const RigidAnswer answer = answer_of(scene, {.max_slices = 30, .max_samples = 600, .max_boxes = 500});
  CHECK(answer.status == Status::kUndecided);
  CHECK(answer.path.empty());
  CHECK(answer.slices <= 31);
  CHECK(answer.samples == 600);
}

TEST_CASE("Two turns lead an L through a window", "[rigid]") {
  Scene scene = load("rigid/l_window");
  // A wider window than that of the file, which takes seconds.
  const std::string wider = R"J({"robot": "box(0,0,0, 1,1,1)",
      "obstacles": ["box(-20,4,-20, 20,33/8,20) - box(-1,4,-1, 1,5,1)"]})J";
  scene.obstacles = scene_of(wider).obstacles;
  const RigidAnswer answer = answer_of(scene);
  check_path(scene, answer, 40);
  const RigidAnswer on_threads = answer_of(scene, {}, Monitor().on_threads(3));
  CHECK(on_threads.slices == answer.slices);
  check_same_path(on_threads, answer);
}

TEST_CASE("A bent tube passes two holes at once", "[rigid]") {
  Scene scene = load("rigid/bent_tube");
  // Wider holes than those of the file, which take seconds.
  const std::string wider = R"J({"robot": "box(0,0,0, 1,1,1)",
      "obstacles": ["box(0,-9,-9, 1/8,9,9) - box(-1,-1,-1, 1,1,1)", "box(2,-9,-9, 17/8,9,9) - box(1,1,-1, 3,3,1)"]})J";
  scene.obstacles = scene_of(wider).obstacles;
  const RigidAnswer answer = answer_of(scene);
  check_path(scene, answer, 40);
  CHECK(answer.slices > 0);
}

TEST_CASE("A slot exactly as wide as the robot is found, however the wall is turned", "[rigid]") {
  Scene scene = scene_of(R"J({"robot": "box(-2,-1/2,-3/2, 2,1/2,3/2)",
      "obstacles": ["box(0,-30,-30, 4,30,30) - box(-1,-1/2,-3/2, 5,1/2,3/2)"],
      "rotation": "SO(3)", "box": [[-10, -10, -10], [10, 10, 10]],
      "start": {"position": [-5, 0, 0], "quaternion": [1, 0, 0, 0]},
      "goal": {"position": [9, 0, 0], "quaternion": [1, 0, 0, 0]}})J");
  const Polyhedron wall = scene.obstacles[0];
  const std::array<Rational3, 2> ends{*scene.start, *scene.goal};
  for (const Quaternion& turn : {Quaternion{7, 0, 0, 1}, Quaternion{5, 2, -1, 3}, Quaternion{9, 4, 8, -2}}) {
    const AffineMap map = map_of({Rational3{}, turn});
    scene.obstacles = {transform(wall, map)};
    scene.start = map(ends[0]);
    scene.goal = map(ends[1]);
    const RigidAnswer answer = answer_of(scene);
    check_path(scene, answer, 40);
    CHECK(answer.slices < 60);
  }
}

TEST_CASE("Where there is room no slices are needed", "[rigid]") {
  const Scene scene =
      scene_of(R"J({"robot": "box(-1,-1/4,-1/4, 1,1/4,1/4)", "obstacles": ["box(-9,4,-9, 9,5,9) - box(-3,3,-3, 3,6,3)"],
      "rotation": "SO(3)", "box": [[-9, -9, -9], [9, 9, 9]],
      "start": {"position": [6, 0, 0], "quaternion": [1, 0, 0, 0]}, "goal": {"position": [6, 8, 0], "quaternion": [1, 1, 0, 0]}})J");
  const RigidAnswer answer = answer_of(scene, {.max_slices = 0, .max_samples = 2000});
  check_path(scene, answer, 100);
  CHECK(answer.slices == 0);
  const RigidAnswer on_threads =
      answer_of(scene, {.max_slices = 0, .max_samples = 2000}, Monitor().on_threads(3));  // by samples
  CHECK(on_threads.samples == answer.samples);
  check_same_path(on_threads, answer);
  // Straight to a goal nearby; no search at all.
  Scene near = scene;
  near.goal = near.start;
  const RigidAnswer straight = answer_of(near);
  CHECK(straight.path.size() == 2);
  CHECK(straight.samples == 0);
  // Stopped at once.
  const TimeLimit limit(0);
  CHECK(answer_of(scene, {}, limit.monitor()).status == Status::kUndecided);
}

TEST_CASE("The first trial that succeeds is the same on any number of threads", "[rigid][threads]") {
  for (const unsigned threads : {1U, 3U}) {
    const Monitor monitor = Monitor().on_threads(threads);
    CHECK(first_true(0, monitor, [](std::size_t, const Monitor&) { return true; }) == 0);
    CHECK(first_true(9, monitor, [](std::size_t, const Monitor&) { return false; }) == 9);
    CHECK(first_true(99, monitor, [](std::size_t i, const Monitor&) { return i % 10 == 7; }) == 7);
    // What is thrown behind it does not matter, what is thrown before it does.
    const auto trial = [](std::size_t failing) {
      return [failing](std::size_t i, const Monitor&) {
        if (i == failing) throw InputError("it fails");
        return i == 20;
      };
    };
    CHECK(first_true(99, monitor, trial(21)) == 20);
    CHECK_THROWS_AS(first_true(99, monitor, trial(19)), InputError);
    // Those behind it are stopped.
    CHECK(first_true(2, monitor, [](std::size_t i, const Monitor& own) {
            for (std::size_t k = 0; i == 1 && k < 10000000000; ++k) own.check_interruption();
            return true;
          }) == 0);
  }
}

TEST_CASE("A proof that takes more boxes than its first turn has is found before slices are made", "[rigid]") {
  const std::string text =
      R"J({"robot": "box(-1,-1,-1/4, 1,1,1/4)", "rotation": "SO(3)", "box": [[-5,-5,-5],[5,5,5]],
      "obstacles": ["box(-1/4,-6,-6, 1/4,6,6) - box(-1,-9/10,-3/8, 1,9/10,3/8)"],
      "start": {"position": [-3,0,0], "quaternion": [1,0,0,0]}, "goal": {"position": [3,0,0], "quaternion": [1,2,0,0]}})J";
  const RigidAnswer answer = answer_of(scene_of(text), {.max_samples = 100});
  REQUIRE(answer.status == Status::kInfeasible);
  CHECK(answer.boxes > 2500);  // those of its first turn
  CHECK(answer.slices == 0);
  const RigidAnswer on_threads = answer_of(scene_of(text), {.max_samples = 100}, Monitor().on_threads(3));
  REQUIRE(on_threads.proof);
  CHECK(proof_text(*on_threads.proof) == proof_text(*answer.proof));
}

TEST_CASE("Start and goal that are not free are said to be, with what they hit", "[rigid]") {
  const std::string text = R"J({"robot": "box(-1,-1/4,-1/4, 1,1/4,1/4)", "obstacles": ["box(2,-9,-9, 3,9,9)"],
      "rotation": "SO(3)", "start": {"position": [START, 0, 0], "quaternion": [1, 0, 0, 0]},
      "goal": {"position": [1.5, 0, 0], "quaternion": GOAL}})J";
  const auto scene = [&](const std::string& start, const std::string& goal) {
    std::string made = text;
    made.replace(made.find("START"), 5, start);
    return scene_of(made.replace(made.find("GOAL"), 4, goal));
  };
  CHECK(answer_of(scene("1.5", "[1, 0, 0, 1]")).status == Status::kInvalidStart);
  const RigidAnswer answer = answer_of(scene("1", "[1, 0, 0, 0]"));
  CHECK(answer.status == Status::kInvalidGoal);
  REQUIRE(answer.collision);
  CHECK(answer.collision->obstacle == 0);
  CHECK(answer_of(scene("1", "[1, 0, 0, 1]")).status == Status::kPath);  // it touches the wall at the start
}

TEST_CASE("The symmetries of a robot are found, and slices are shared", "[rigid]") {
  const auto slices_of = [](const std::string& robot) {
    return Slices(scene_of(R"J({"obstacles": ["box(4,4,4, 5,5,5)"], "robot": ")J" + robot + "\"}"));
  };
  CHECK(slices_of("box(-1,-1,-1, 1,1,1)").symmetries().size() == 24);
  CHECK(slices_of("box(-2,-1,-1, 2,1,1)").symmetries().size() == 8);
  CHECK(slices_of("box(-3,-2,-1, 3,2,1)").symmetries().size() == 4);
  CHECK(slices_of("box(0,0,0, 1,1,1)").symmetries().size() == 3);
  CHECK(slices_of("box(0,0,0, 3,2,1)").symmetries().size() == 1);
  Slices slices = slices_of("box(-2,-1,-1, 2,1,1)");
  const Slice& slice = slices.at({1, 0, 0, 0}, {});
  CHECK(&slices.at({0, 1, 0, 0}, {}) == &slice);
  CHECK(slices.shared({1, 1, 0, 0}) == slices.shared({1, 0, 0, 0}));
  CHECK(slices.shared({1, 0, 0, 1}) != slices.shared({1, 0, 0, 0}));
  REQUIRE(slice.components.size() == 1);
  CHECK(slice.component_at({0, 0, 0}) == std::size_t{0});
  CHECK_FALSE(slice.component_at({4, 4, 4}));
  for (const Rational3& p : slice.components[0].points) CHECK(slice.component_at(p) == std::size_t{0});
}

TEST_CASE("Slices of bodies that are cut up once are the free positions of the turned robot", "[rigid]") {
  const std::string l = "box(-1,-1/4,-1/4, 1,1/4,1/4) + box(-1,-1/4,-1/4, -1/2,1/4,1)";
  const std::string boxes = R"J("box(1,1,1, 3,2,4)", "box(2,1,0, 4,5,3) - box(3,2,1, 5,4,2)", "box(0,4,0, 3,4,5)")J";
  const std::string in_box = R"J(, "box": [[0,0,0],[5,5,5]])J";
  const std::string robot = R"J({"robot": ")J";
  const std::string obstacles = R"J(", "obstacles": [)J";
  for (const std::string& text :
       {robot + l + obstacles + boxes + "]}", robot + l + obstacles + boxes + "]" + in_box + "}",
        robot + l + obstacles + boxes + R"J(, "halfspace(1,1,1,-2)"])J" + in_box + "}",
        robot + l + " + box(1,-1,0, 2,1,0)" + obstacles + boxes + "]" + in_box + "}"}) {
    INFO(text);
    Scene scene = scene_of(text);
    for (const ContactRule contact : {ContactRule::kAllow, ContactRule::kForbid}) {
      scene.contact = contact;
      Slices slices(scene);
      Slices uncut(scene, {}, false);
      for (const Quaternion& q : {Quaternion{1, 0, 0, 0}, {1, 1, 0, 0}, {1, ratio(1, 2), ratio(-1, 4), 1}}) {
        Scene turned = scene;
        turned.robot = transform(scene.robot, map_of({Rational3{}, q}));
        CHECK(equal(slices.at(q, {}).free->set(), free_positions(turned)));
        CHECK(equal(uncut.at(q, {}).free->set(), free_positions(turned)));
      }
    }
  }
}

TEST_CASE("Paths become shorter, with the same ends", "[rigid][threads]") {
  const Scene scene = load("rigid/l_window");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  const std::vector<RigidPose> detour{
      {{0, -1, 0}}, {{2, -3, 1}, {2, 0, 1, 0}}, {{-3, -3, 1}, {1, 0, 1, 0}}, {{1, -2, 0}, {3, 0, 1, 0}}, {{-1, -2, 0}}};
  REQUIRE(certify(checker, detour).status == MotionVerdict::Status::kFree);
  const std::vector<RigidPose> path = shorten(checker, detour);
  CHECK(path.size() == 2);
  // Round a box, on any number of threads.
  const MotionChecker among = MotionChecker::of_scene(
      scene_of(R"J({"robot": "box(-1,-1/4,-1/4, 1,1/4,1/4)", "obstacles": ["box(2,-3,-3, 3,3,3)"],
      "start": [0,0,0], "goal": [5,0,0]})J"));
  const std::vector<RigidPose> round{{{0, 0, 0}}, {{0, 6, 0}}, {{5, 6, 0}, {1, 0, 1, 0}}, {{5, 0, 0}}};
  REQUIRE(certify(among, round).status == MotionVerdict::Status::kFree);
  const std::vector<RigidPose> shorter = shorten(among, round);
  CHECK(shorter.size() > 2);
  CHECK(shorter[1].position != round[1].position);
  for (const unsigned threads : {2U, 5U}) {
    const std::vector<RigidPose> on_threads = shorten(among, round, Monitor().on_threads(threads));
    REQUIRE(on_threads.size() == shorter.size());
    for (std::size_t i = 0; i < shorter.size(); ++i) CHECK(on_threads[i].position == shorter[i].position);
  }
  CHECK(path.front().position == detour.front().position);
  CHECK(path.back().position == detour.back().position);
}

// A bar or an L among boxes, with start and goal anywhere.
Scene random_scene(std::mt19937& random) {
  const auto number = [&](int low, int high) { return low + static_cast<int>(random() % unsigned(high - low + 1)); };
  const auto list = [](int x, int y, int z) {
    return std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z);
  };
  std::string obstacles;
  for (int i = 0; i < 3; ++i) {
    const std::array<int, 3> low{number(0, 5), number(0, 5), number(0, 5)};
    obstacles += (i == 0 ? "\"box(" : ", \"box(") + list(low[0], low[1], low[2]) + ", " +
                 list(low[0] + number(1, 3), low[1] + number(1, 3), low[2] + number(1, 3)) + ")\"";
  }
  const auto pose = [&] {
    const std::array<int, 6> v{number(0, 6), number(0, 6), number(0, 6), number(-1, 1), number(-1, 1), number(-1, 1)};
    return R"J({"position": [)J" + list(v[0], v[1], v[2]) + R"J(], "quaternion": [1, )J" + list(v[3], v[4], v[5]) +
           "]}";
  };
  const std::string robot = random() % 2 == 0 ? "box(-1,-1/4,-1/4, 1,1/4,1/2)"
                                              : "box(-1,-1/4,-1/4, 1,1/4,1/4) + box(-1,-1/4,-1/4, -1/2,1/4,1)";
  const std::string start = pose();
  const std::string goal = pose();
  return scene_of(R"J({"rotation": "SO(3)", "box": [[0,0,0],[6,6,6]], "robot": ")J" + robot + R"J(", "obstacles": [)J" +
                  obstacles + R"J(], "start": )J" + start + R"J(, "goal": )J" + goal + "}");
}

// A way on a coarse grid of poses, each motion of it certified: positions are whole numbers, rotations those of level
// 0.
bool has_grid_way(const Scene& scene, const MotionChecker& checker) {
  const RigidQuestion question = rigid_question_of(scene);
  const auto key = [](const RigidPose& pose) { return std::pair(pose.position, canonical(pose.quaternion)); };
  std::set<std::pair<Rational3, Quaternion>> seen{key(question.start)};
  std::vector<RigidPose> open{question.start};
  while (!open.empty() && seen.size() < 3000) {
    const RigidPose at = open.back();
    open.pop_back();
    std::vector<RigidPose> next;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int step : {-1, 1}) {
        next.push_back(at);
        next.back().position[k] += step;
      }
    }
    for (const Quaternion& q : grid_neighbours(canonical(at.quaternion), 0)) next.push_back({at.position, q});
    for (const RigidPose& to : next) {
      if (seen.count(key(to)) > 0 || !checker.in_box(to.position)) continue;
      const RigidMotion motion(at, to, MotionTiming::kSlerp);
      if (checker.check(motion, CheckLimits::for_planners()).status != MotionVerdict::Status::kFree) continue;
      if (key(to) == key(question.goal)) return true;
      seen.insert(key(to));
      open.push_back(to);
    }
  }
  return false;
}

TEST_CASE("Random scenes: ways of a grid of poses are found, and paths are free", "[rigid]") {
  std::mt19937 random(20261127);
  std::size_t found = 0;
  for (unsigned i = 0; i < seeds(12); ++i) {
    INFO(i);
    const Scene scene = random_scene(random);
    const RigidAnswer answer = answer_of(scene, {.max_slices = 40, .max_samples = 2000, .max_boxes = 1000});
    const RigidQuestion question = rigid_question_of(scene);
    if (answer.status == Status::kInvalidStart || answer.status == Status::kInvalidGoal) {
      CHECK(find_collision(scene, answer.status == Status::kInvalidStart ? question.start : question.goal));
    } else if (answer.status == Status::kPath) {
      ++found;
      check_path(scene, answer, 12);
    } else {  // undecided, or proved that there is none
      CHECK_FALSE(has_grid_way(scene, MotionChecker::of_scene(scene)));
    }
  }
  CHECK(found > nef::test::fewer(2));
}

TEST_CASE("A cube does not pass a smaller window however it is turned", "[rigid]") {
  const std::string text =
      R"J({"robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "rotation": "SO(3)", "box": [[-3,-3,-3],[3,3,3]],
      "obstacles": ["box(-1/2,-4,-4, 1/2,4,4) - box(-1,-1/4,-1/4, 1,1/4,1/4)"],
      "start": {"position": [-2,0,0], "quaternion": [1,0,0,0]}, "goal": {"position": [2,0,0], "quaternion": [1,2,0,0]}})J";
  const RigidAnswer answer = answer_of(scene_of(text), {.max_slices = 10, .max_samples = 200});
  REQUIRE(answer.status == Status::kInfeasible);
  REQUIRE(answer.proof);
  CHECK_FALSE(complaint_about(*answer.proof));
  CHECK(answer.boxes > 0);
  const Folder folder;
  const std::string window = folder.write("window.json", text);
  const Run run =
      planner(folder, window + " --max-cells 10 --proof " + folder.file("w.proof") + " -o " + folder.file("w.json"));
  CHECK(run.code == 1);
  CHECK_THAT(run.out, Catch::Contains("infeasible at every orientation"));
  CHECK_THAT(text_of(folder.file("w.json")), Catch::Contains(R"("status": "infeasible")"));
  CHECK(planner(folder, window + " --check-proof " + folder.file("w.proof")).code == 0);
  // Stopped before: what of the barrier is in question is told.
  std::string wider = text;  // which takes more boxes
  wider.replace(wider.find("box(-1,-1/4,-1/4, 1,1/4,1/4)"), 28, "box(-1,-19/40,-19/40, 1,19/40,19/40)");
  const Run stopped =
      planner(folder, folder.write("wider.json", wider) + " --max-cells 1 -o " + folder.file("stopped.json"));
  CHECK(stopped.code == 5);
  CHECK_THAT(stopped.out, Catch::Contains("may not be blocked at all orientations"));
  const nlohmann::json report = nlohmann::json::parse(text_of(folder.file("stopped.json")));
  CHECK(report["in_question"]["reference"].size() == 3);
  CHECK_FALSE(report["in_question"]["boxes"].empty());
}

TEST_CASE("The program plans for robots that turn freely", "[rigid]") {
  const Folder folder;
  const std::string elbow = source_folder() + "/data/planner/rigid/elbow.json";
  const std::string files = " -o " + folder.file("a.json") + " -o " + folder.file("a.path") + " -o " +
                            folder.file("a.glb") + " --page " + folder.file("a.html") + " --proof " +
                            folder.file("a.proof");
  const Run run = planner(folder, elbow + files);
  CHECK(run.code == 0);
  CHECK_THAT(run.out, Catch::Contains("every motion certified"));
  CHECK(planner(folder, elbow + " --path " + folder.file("a.json")).code == 0);
  CHECK(planner(folder, elbow + " --check-proof " + folder.file("a.proof")).code == 0);
  const std::string open = folder.write("open.json", R"J({"robot": "box(-1,-1/4,-1/4, 1,1/4,1/4)", "rotation": "SO(3)",
      "obstacles": ["box(2,-9,-9, 3,9,9)"], "start": {"position": [0, 0, 0], "quaternion": [1, 0, 0, 0]},
      "goal": {"position": [0, 0, 3], "quaternion": [1, 0, 0, 1]}})J");
  CHECK(planner(folder, open + " --proof " + folder.file("b.proof")).code == 0);
  CHECK(planner(folder, open + " --check-proof " + folder.file("b.proof")).code == 0);
  CHECK_THAT(text_of(folder.file("a.json")), Catch::Contains(R"("motions": "rigid")"));
  CHECK_THAT(text_of(folder.file("a.glb")).substr(0, 4), Catch::Equals("glTF"));
  const Run stopped = planner(folder, elbow + " --max-cells 2 --json");
  CHECK(stopped.code == 5);
  CHECK_THAT(stopped.out, Catch::Contains(R"("status": "undecided")"));
  CHECK(planner(folder, elbow + " --start 0,0,0,1,1,1,1").code == 3);
  for (const char* option : {"--tight", "--benchmark bench.log", "--raw", "--digits 3", "--widest", "-o a.xyz"}) {
    INFO(option);
    const Run refused = planner(folder, elbow + " " + option);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Catch::Contains("turns freely"));
  }
}

}  // namespace
}  // namespace nef::planner::test::rigid_planning
