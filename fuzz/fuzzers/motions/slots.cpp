// SPDX-License-Identifier: Apache-2.0
//
// Prisms that turn freely, in front of a thick wall with a slot of exactly their cross section; wall, slot and the way
// through it are turned by a random quaternion. There is a path: turn, go straight through, turn again. It must be
// found, and what is found is looked at pose by pose, by Booleans of the moved robot.
#include <string>
#include <vector>

#include "apps/planner/free_space/collision.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"

namespace nef::fuzz {
namespace {

using planner::MotionChecker;
using planner::MotionTiming;
using planner::MotionVerdict;
using planner::Quaternion;
using planner::RigidAnswer;
using planner::RigidMotion;

Rational parts_of_eight(int x) { return Rational(x) / 8; }

class SlotCase {
 public:
  explicit SlotCase(const Case& the_case) : case_(the_case) { draw(); }

  void run() {
    const MotionChecker checker = MotionChecker::of_scene(scene_);
    Case::require(is_free(checker, {{*scene_.start, turn_}, {*scene_.goal, turn_}}), "the way through is not free");
    const RigidAnswer answer =
        planner::find_rigid_path(scene_, checker, {.max_slices = 200, .max_samples = 1000, .max_boxes = 0});
    Case::require(answer.status == RigidAnswer::Status::kPath, "no path is found");
    case_.count("paths");
    case_.count("slices", answer.slices);
    const std::vector<planner::RigidPose>& path = answer.path;
    Case::require(path.front().position == *scene_.start && path.back().position == *scene_.goal, "wrong ends");
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      Case::require(is_free(checker, {path[i], path[i + 1], MotionTiming::kSlerp}), "a motion is not free");
    }
    for (const planner::RigidPose& pose : path) {
      Case::require(!planner::find_collision(scene_, pose), "a way-point collides");
      case_.count("way-points");
    }
  }

 private:
  static bool is_free(const MotionChecker& checker, const RigidMotion& motion) {
    return checker.check(motion).status == MotionVerdict::Status::kFree;
  }

  Quaternion random_quaternion() {
    Choices& choices = case_.choices();
    Quaternion q{choices.between(1, 9), choices.between(-9, 9), choices.between(-9, 9), choices.between(-9, 9)};
    case_.tell("quaternion " + to_string(q[0]) + " " + to_string(q[1]) + " " + to_string(q[2]) + " " + to_string(q[3]));
    return q;
  }

  // The hull of a polygon in the plane across x, at two values of x.
  [[nodiscard]] Polyhedron prism(const Rational& from, const Rational& to) const {
    std::vector<Rational3> points;
    for (const auto& [y, z] : section_) {
      points.push_back({from, y, z});
      points.push_back({to, y, z});
    }
    return convex_hull(points);
  }

  void draw() {
    Choices& choices = case_.choices();
    section_ = {
        {parts_of_eight(-4), parts_of_eight(-4)}, {parts_of_eight(4), parts_of_eight(-4)}, {0, parts_of_eight(4)}};
    for (std::uint32_t more = choices.below(4); more > 0; --more) {
      const Rational y = parts_of_eight(choices.between(-12, 12));
      const Rational z = parts_of_eight(choices.between(-12, 12));
      section_.push_back({y, z});
      case_.tell("corner " + to_string(y) + " " + to_string(z));
    }
    const Rational half = parts_of_eight(choices.between(2, 12));
    const Rational thickness = parts_of_eight(choices.between(1, 32));
    case_.tell("prism " + to_string(2 * half) + " long, wall of " + to_string(thickness));
    turn_ = random_quaternion();
    const AffineMap map = planner::map_of({Rational3{}, turn_});
    constexpr int kFar = 30;  // farther than the box reaches
    const Polyhedron wall = make_box({0, -kFar, -kFar}, {thickness, kFar, kFar});
    scene_.robot = prism(-half, half);
    scene_.obstacles = {transform(subtract(wall, prism(-1, thickness + 1)), map)};
    scene_.obstacle_names = {"wall"};
    scene_.box = {{{-14, -14, -14}, {14, 14, 14}}};
    scene_.turns_freely = true;
    scene_.start = map({-5, 0, 0});
    scene_.goal = map({thickness + 5, 0, 0});
    scene_.quaternions = {{{1, 0, 0, 0}, random_quaternion()}};
  }

  const Case& case_;
  std::vector<std::array<Rational, 2>> section_;
  Quaternion turn_;
  planner::Scene scene_;
};

}  // namespace

void fuzz_slots(const Case& the_case) { SlotCase(the_case).run(); }

}  // namespace nef::fuzz
