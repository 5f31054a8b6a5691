// SPDX-License-Identifier: Apache-2.0
//
// Convex robots in front of a wall with a rectangular hole around the x axis. Turned by a random quaternion the robot
// extends over a rectangle across the axis. If that is no larger than the hole, there is a path: turn, go straight
// through, turn back. Then there must be no proof that there is none. A proof of a
// smaller hole must hold, and no straight way at a random orientation may be free.
#include <algorithm>
#include <string>
#include <vector>

#include "apps/planner/no_path/no_rigid_path.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::fuzz {
namespace {

using planner::MotionChecker;
using planner::NoPathAnswer;
using planner::Quaternion;
using planner::RigidPose;

Rational fraction(int numerator, int denominator) {
  Rational result(numerator, denominator);
  result.canonicalize();
  return result;
}

class NoPathCase {
 public:
  explicit NoPathCase(const Case& the_case) : case_(the_case) {}

  void run() {
    draw_robot();
    const Quaternion q = random_quaternion();
    const auto [low, high] = extent(q);
    // The hole, wider or narrower than what it takes at this orientation.
    const Rational share = fraction(case_.choices().between(1, 20), 16);
    Rational3 from{-1, 0, 0};
    Rational3 to{1, 0, 0};
    for (std::size_t k = 1; k < 3; ++k) {
      from[k] = share * low[k];
      to[k] = share * high[k];
    }
    const Polyhedron wall = subtract(make_box({Rational(-1, 4), -9, -9}, {Rational(1, 4), 9, 9}), make_box(from, to));
    case_.tell("hole " + to_string(from[1]) + " " + to_string(from[2]) + " to " + to_string(to[1]) + " " +
               to_string(to[2]));
    planner::Scene scene;
    scene.robot = convex_hull(vertices_);
    scene.obstacles = {wall};
    scene.obstacle_names = {"wall"};
    scene.box = {{{-8, -8, -8}, {8, 8, 8}}};
    scene.start = Rational3{-6, 0, 0};
    scene.goal = Rational3{6, 0, 0};
    scene.turns_freely = true;
    scene.quaternions = {{{1, 0, 0, 0}, random_quaternion()}};
    const NoPathAnswer answer = planner::prove_no_rigid_path(scene, {.max_cells = 3000});
    case_.count("walls");
    if (!answer.proof) return;
    case_.count("proofs");
    Case::require(share < 1, "a proof: the robot passes this hole");
    const auto complaint = planner::complaint_about(*answer.proof);
    Case::require(!complaint, "a proof: " + complaint.value_or(""));
    const MotionChecker checker = MotionChecker::of_scene(scene);
    for (int i = 0; i < 20; ++i) {
      const Quaternion turned = random_quaternion();
      const Rational y = fraction(case_.choices().between(-4, 4), 8);
      const planner::RigidMotion motion({{-6, y, 0}, turned}, {{6, y, 0}, turned});
      Case::require(checker.check(motion).status != planner::MotionVerdict::Status::kFree,
                    "a proof: a straight way is free");
    }
  }

 private:
  Quaternion random_quaternion() {
    Choices& choices = case_.choices();
    Quaternion q{choices.between(1, 4), choices.between(-3, 3), choices.between(-3, 3), choices.between(-3, 3)};
    case_.tell("quaternion " + to_string(q[0]) + " " + to_string(q[1]) + " " + to_string(q[2]) + " " + to_string(q[3]));
    return q;
  }

  // A box, or the hull of points around the origin, which is inside.
  void draw_robot() {
    Choices& choices = case_.choices();
    for (int corner = 0; corner < 8; ++corner) {
      Rational3 v;
      for (int k = 0; k < 3; ++k) v[static_cast<std::size_t>(k)] = ((corner >> k) & 1) != 0 ? 1 : -1;
      const bool is_moved = choices.one_in(3);
      for (Rational& x : v) x *= fraction(is_moved ? choices.between(4, 12) : 8, 8);
      vertices_.push_back(v);
      case_.tell("vertex " + to_string(v[0]) + " " + to_string(v[1]) + " " + to_string(v[2]));
    }
  }

  [[nodiscard]] std::array<Rational3, 2> extent(const Quaternion& q) const {
    const planner::Matrix3 turn = planner::rotation_between(q, q);
    std::array<Rational3, 2> result;
    for (const Rational3& v : vertices_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational at = dot(turn[k], v);
        result[0][k] = std::min(result[0][k], at);
        result[1][k] = std::max(result[1][k], at);
      }
    }
    return result;
  }

  const Case& case_;
  std::vector<Rational3> vertices_;
};

}  // namespace

void fuzz_no_paths(const Case& the_case) { NoPathCase(the_case).run(); }

}  // namespace nef::fuzz
