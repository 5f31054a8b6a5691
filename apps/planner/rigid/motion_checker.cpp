// SPDX-License-Identifier: Apache-2.0
//
// The examination of one motion is a search over its parts. A part comes with the pairs of nodes, one of each tree,
// that its parent could not keep apart. It drops those that are apart now, splits nodes that are large beside what they
// sweep, and leaves the others as they are, since halving the time will help more. What remains is checked at the pose
// in the middle, which finds collisions, and goes to both halves.
#include "apps/planner/rigid/motion_checker.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "apps/planner/free_space/hulls_apart.h"
#include "apps/planner/rigid/separation.h"
#include "apps/planner/turning/reachable_part.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

// As in separation.cpp: two images, and the sums and products around them. An infinite sum is not above an infinite
// error.
constexpr double kBoxError = 2 * MotionCell::kImageError;

}  // namespace

/// One call of MotionChecker::check.
class MotionExamination {
 public:
  MotionExamination(const MotionChecker& checker, const RigidMotion& motion, const CheckLimits& limits)
      : checker_(checker), motion_(motion), cells_(motion), limits_(limits) {
    limits_.depth = std::min(limits_.depth, 40U);  // parameters and their complements are exact doubles
  }

  MotionVerdict run() {
    if (!checker_.in_box(motion_.from().position)) return collision_outside(0);
    if (!checker_.in_box(motion_.to().position)) return collision_outside(1);
    if (limits_.in_order) {
      if (collides_at(0)) verdict_.free_until = 0;
    } else if (collides_at(0) || collides_at(1)) {
      return verdict_;
    }
    if (verdict_.status == MotionVerdict::Status::kCollides) return verdict_;
    parts_.push_back({0, 1, 0, root()});
    while (!parts_.empty()) {
      Part part = std::move(limits_.in_order ? parts_.back() : parts_.front());
      limits_.in_order ? parts_.pop_back() : parts_.pop_front();
      if (!examine(part)) return verdict_;
    }
    std::sort(verdict_.parts.begin(), verdict_.parts.end());
    if (!verdict_.undecided.empty()) {
      verdict_.status = MotionVerdict::Status::kUndecided;
      std::sort(verdict_.undecided.begin(), verdict_.undecided.end());
    }
    return verdict_;
  }

  /// The pose at a parameter, exactly if need be.
  bool collides_at(double s) {
    std::vector<Pair> pairs = root();
    return collides_at(s, pairs, true);
  }

  MotionVerdict take() { return std::move(verdict_); }

 private:
  using Pair = std::array<std::uint32_t, 2>;  // nodes of the robot's tree and of the obstacles'

  // A part of the motion that is still to be looked at.
  struct Part {
    double from = 0;
    double to = 1;
    unsigned depth = 0;
    std::vector<Pair> pairs;
  };

  [[nodiscard]] std::vector<Pair> root() const {
    const bool nothing = checker_.robot_.nodes().empty() || checker_.obstacles_.nodes().empty();
    return nothing ? std::vector<Pair>{} : std::vector<Pair>{{0, 0}};
  }

  MotionVerdict collision_outside(double s) {
    verdict_.status = MotionVerdict::Status::kCollides;
    verdict_.pose = motion_.at(s);
    verdict_.parameter = s;
    verdict_.free_until = 0;
    return verdict_;
  }

  // False if the examination has ended.
  bool examine(Part& part) {
    ++verdict_.cells;
    const MotionCell cell = cells_.part(part.from, part.to);
    const bool last = part.depth >= limits_.depth || verdict_.cells >= limits_.max_cells;
    std::vector<Pair> rest = cell.wide ? part.pairs : not_apart(part, cell, last);
    // A part that turns far has no images, so it is no part of a proof although there is nothing to hit.
    if (rest.empty() && !(limits_.keep_parts && cell.wide)) {
      if (limits_.keep_parts) verdict_.parts.push_back({part.from, part.to});
      return true;
    }
    const double middle = (part.from + part.to) / 2;
    if (!limits_.in_order || last) {
      if (collides_at(middle, rest, last && exact_tests_ < limits_.max_exact)) {
        verdict_.free_until = part.from;
        return false;
      }
    }
    if (last) {
      if (verdict_.undecided.size() < limits_.max_cells) verdict_.undecided.push_back({part.from, part.to});
      if (limits_.in_order) {
        verdict_.free_until = part.from;
        verdict_.status = MotionVerdict::Status::kUndecided;
        return false;
      }
      return true;
    }
    Part first{part.from, middle, part.depth + 1, rest};
    Part second{middle, part.to, part.depth + 1, std::move(rest)};
    if (limits_.in_order) std::swap(first, second);
    parts_.push_back(std::move(first));
    parts_.push_back(std::move(second));
    return true;
  }

  // The pairs of nodes that are not proved to be apart in a part of the motion.
  std::vector<Pair> not_apart(const Part& part, const MotionCell& cell, bool last) {
    std::vector<Pair> rest;
    std::vector<Pair> stack = part.pairs;
    // Beside nodes of this size, what a pair sweeps is large.
    constexpr double kSweepBesideSize = 1;
    while (!stack.empty()) {
      const Pair pair = stack.back();
      stack.pop_back();
      const RigidBody::Node& a = checker_.robot_.nodes()[pair[0]];
      const RigidBody::Node& b = checker_.obstacles_.nodes()[pair[1]];
      if (boxes_apart(cell, a, b)) continue;
      if (a.leaf && b.leaf) {
        if (!leaves_apart(part, cell, a.first, b.first)) rest.push_back(pair);
        continue;
      }
      const double sweep = cell.position_spread + cell.turn_spread * a.reach;
      if (!last && sweep > kSweepBesideSize * (a.radius + b.radius)) {
        rest.push_back(pair);
      } else {
        split(pair, a, b, stack);
      }
    }
    return rest;
  }

  static void split(const Pair& pair, const RigidBody::Node& a, const RigidBody::Node& b, std::vector<Pair>& stack) {
    const bool split_a = b.leaf || (!a.leaf && a.radius > b.radius);
    for (const std::uint32_t child : {0U, 1U}) {
      stack.push_back(split_a ? Pair{a.first + child, pair[1]} : Pair{pair[0], b.first + child});
    }
  }

  // The box of a node of the robot, turned, lies in that about M centre with the halves |M| half.
  static bool boxes_apart(const MotionCell& cell, const RigidBody::Node& a, const RigidBody::Node& b) {
    const double error = kBoxError * (2 * a.reach + b.reach + cell.position_reach) + MotionCell::kVanished;
    Vector3d low = Vector3d::Constant(HUGE_VAL);
    Vector3d high = Vector3d::Constant(-HUGE_VAL);
    for (std::size_t i = 0; i < cell.turn_count; ++i) {
      const Vector3d centre = cell.turns[i] * a.centre;
      const Vector3d half = cell.turns[i].cwiseAbs() * a.half;
      low = low.cwiseMin(centre - half);
      high = high.cwiseMax(centre + half);
    }
    Vector3d from = cell.positions[0];
    Vector3d to = from;
    if (cell.position_count == 2) {
      from = from.cwiseMin(cell.positions[1]);
      to = to.cwiseMax(cell.positions[1]);
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (low[k] + from[k] > b.centre[k] + b.half[k] + error) return true;
      if (high[k] + to[k] < b.centre[k] - b.half[k] - error) return true;
    }
    return false;
  }

  bool leaves_apart(const Part& part, const MotionCell& cell, std::uint32_t robot, std::uint32_t obstacle) {
    const RigidBody::Piece& a = checker_.robot_.pieces()[robot];
    const RigidBody::Piece& b = checker_.obstacles_.pieces()[obstacle];
    place(a, cell, rough_robot_);
    place(b, rough_obstacle_);
    const Separation separation = plane_between(rough_robot_, rough_obstacle_);
    if (separation == Separation::kApart) return true;
    if (separation != Separation::kPerhaps || exact_tests_ >= limits_.max_exact) return false;
    // What touches in the closed sense is no case for smaller parts, but for the pose at which it does.
    if (checker_.closed(a, b)) return false;
    ++exact_tests_;
    const std::vector<Rational3> swept = cells_.exact_images(part.from, part.to, a.mesh.vertices);
    if (!hulls_are_apart(swept, b.mesh.vertices, false)) return false;
    verdict_.touches = true;
    return true;
  }

  // True if a pair collides at a pose; the verdict says which. Pairs that doubles leave open are decided exactly if
  // `exact`, else taken for free.
  bool collides_at(double s, const std::vector<Pair>& pairs, bool exact) {
    const MotionCell cell = cells_.pose(s);
    std::vector<Pair> stack = pairs;
    while (!stack.empty()) {
      const Pair pair = stack.back();
      stack.pop_back();
      const RigidBody::Node& a = checker_.robot_.nodes()[pair[0]];
      const RigidBody::Node& b = checker_.obstacles_.nodes()[pair[1]];
      if (boxes_apart(cell, a, b)) continue;
      if (!a.leaf || !b.leaf) {
        split(pair, a, b, stack);
      } else if (collide(s, cell, a.first, b.first, exact)) {
        verdict_.status = MotionVerdict::Status::kCollides;
        verdict_.pose = motion_.at(s);
        verdict_.parameter = s;
        verdict_.robot_piece = a.first;
        verdict_.obstacle_piece = b.first;
        return true;
      }
    }
    return false;
  }

  bool collide(double s, const MotionCell& cell, std::uint32_t robot, std::uint32_t obstacle, bool exact) {
    const RigidBody::Piece& a = checker_.robot_.pieces()[robot];
    const RigidBody::Piece& b = checker_.obstacles_.pieces()[obstacle];
    place(a, cell, rough_robot_);
    place(b, rough_obstacle_);
    if (plane_between(rough_robot_, rough_obstacle_) == Separation::kApart) return false;
    rough_robot_.normals.clear();
    for (const Vector3d& n : a.normals) rough_robot_.normals.emplace_back(cell.turns[0] * n);
    const bool between = s != 0 && s != 1;
    const double slack = between ? cells_.position_error() : 0;
    if (overlap(a, rough_robot_, b, slack) == Separation::kOverlapping) return true;
    // Where the position is not known exactly, neither is contact.
    if (!exact || slack > 0) return false;
    if (between) ++exact_tests_;
    const std::vector<Rational3> placed = cells_.exact_images(s, s, a.mesh.vertices);
    return !hulls_are_apart(placed, b.mesh.vertices, checker_.closed(a, b));
  }

  const MotionChecker& checker_;
  const RigidMotion& motion_;
  MotionCells cells_;
  CheckLimits limits_;
  std::deque<Part> parts_;
  std::size_t exact_tests_ = 0;
  MotionVerdict verdict_;
  RoughPolytope rough_robot_;
  RoughPolytope rough_obstacle_;
};

MotionChecker::MotionChecker(RigidBody robot, RigidBody obstacles, ContactRule contact,
                             std::optional<std::array<Rational3, 2>> box)
    : robot_(std::move(robot)), obstacles_(std::move(obstacles)), contact_(contact), box_(std::move(box)) {}

MotionChecker MotionChecker::of_scene(const Scene& scene, const Monitor& monitor) {
  std::vector<RigidBody> obstacles;
  for (const Polyhedron& obstacle : scene.obstacles) {
    const Polyhedron reachable = reachable_part(obstacle, scene, monitor);
    if (!reachable.is_empty()) obstacles.push_back(RigidBody::of_set(closure(reachable, monitor), monitor));
  }
  return {RigidBody::of_set(closure(scene.robot, monitor), monitor), RigidBody::together(obstacles), scene.contact,
          scene.box};
}

bool MotionChecker::in_box(const Rational3& position) const {
  if (!box_) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (position[k] < (*box_)[0][k] || position[k] > (*box_)[1][k]) return false;
  }
  return true;
}

MotionVerdict MotionChecker::check(const RigidPose& pose) const {
  const RigidMotion still(pose, pose);
  MotionVerdict verdict;
  if (!in_box(pose.position)) {
    verdict.status = MotionVerdict::Status::kCollides;
    verdict.pose = pose;
    return verdict;
  }
  MotionExamination examination(*this, still, {});
  examination.collides_at(0);
  return examination.take();
}

MotionVerdict MotionChecker::check(const RigidMotion& motion, const CheckLimits& limits) const {
  return MotionExamination(*this, motion, limits).run();
}

}  // namespace nef::planner
