// SPDX-License-Identifier: Apache-2.0
//
// The examination of one motion is a search over its parts. A part comes with the pairs of nodes, one of each tree,
// that its parent could not keep apart. It drops those that are apart now, splits nodes that are large beside what they
// sweep, and leaves the others as they are, since halving the time will help more. What remains is checked at the pose
// in the middle, which finds collisions, and goes to both halves. A motion that does not turn sweeps exactly the hull
// of its images, so a few halvings do there: a common point of that hull and an obstacle says when they meet.
#include "apps/planner/rigid/motion_checker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/planner/intersection/common_point.h"
#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/rigid/close_pieces.h"
#include "apps/planner/rigid/motion_parts.h"
#include "apps/planner/rigid/separation.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/error.h"

namespace nef::planner {

/// One call of MotionChecker::check.
class MotionExamination {
 public:
  MotionExamination(const MotionChecker& checker, const RigidMotion& motion, const CheckLimits& limits,
                    const Monitor& monitor)
      : checker_(checker),
        motion_(motion),
        cells_(motion),
        limits_(limits),
        monitor_(monitor),
        parts_(limits.in_order) {
    limits_.depth = std::min(limits_.depth, 40U);  // parameters and their complements are exact doubles
  }

  MotionVerdict run() {
    if (!checker_.in_box(motion_.from().position)) return collision_outside(0);
    if (!checker_.in_box(motion_.to().position)) return collision_outside(1);
    // Planners begin where nothing collides: the other end comes first, and the start when it takes long.
    if (collides_at(limits_.in_order ? 0 : 1)) {
      if (limits_.in_order) verdict_.free_until = 0;
      return verdict_;
    }
    parts_.add({0, 1, 0, root()});
    constexpr std::size_t kCellsBeforeStart = 16;
    bool start_is_free = limits_.in_order;
    while (!parts_.empty()) {
      if (!examine(parts_.next())) return verdict_;
      // If all parts are free, the start is, too.
      const bool is_needed = verdict_.cells >= kCellsBeforeStart || (parts_.empty() && !verdict_.undecided.empty());
      if (start_is_free || !is_needed) continue;
      if (collides_at(0)) return verdict_;
      start_is_free = true;
    }
    std::sort(verdict_.parts.begin(), verdict_.parts.end());
    if (!verdict_.undecided.empty()) {
      verdict_.status = MotionVerdict::Status::kUndecided;
      std::sort(verdict_.undecided.begin(), verdict_.undecided.end());
    }
    return verdict_;
  }

  /// The pose at a parameter, exactly if need be.
  bool collides_at(double s) { return collides_at(s, root(), true); }

  MotionVerdict take() { return std::move(verdict_); }

 private:
  using Pair = NodePair;  // of the robot's tree and of the obstacles'

  using Part = MotionParts<std::vector<Pair>>::Part;

  // Whether contact of two pieces is a collision.
  [[nodiscard]] bool closed(const RigidBody::Piece& a, const RigidBody::Piece& b) const {
    return checker_.contact_ == ContactRule::kForbid || (limits_.surfaces_block && (a.flat || b.flat));
  }

  [[nodiscard]] std::vector<Pair> root() const { return root_pair(checker_.robot_, checker_.obstacles_); }

  MotionVerdict collision_outside(double s) {
    tell_collision(s);
    verdict_.free_until = 0;
    return verdict_;
  }

  void tell_collision(double s) {
    verdict_.status = MotionVerdict::Status::kCollides;
    if (limits_.keep_pose) verdict_.pose = motion_.at(s);
    verdict_.parameter = s;
    verdict_.undecided.clear();
  }

  void tell_straight_collision(const Rational& s) {
    tell_collision(nearest_double(s));
    if (!limits_.keep_pose) return;
    const Rational3& from = motion_.from().position;
    for (std::size_t k = 0; k < 3; ++k) {
      verdict_.pose->position[k] = from[k] + s * (motion_.to().position[k] - from[k]);
    }
  }

  // False if the examination has ended.
  bool examine(const Part& part) {
    monitor_.check_interruption();
    ++verdict_.cells;
    constexpr unsigned kStraightDepth = 4;
    const bool straight = !motion_.turns() && part.depth >= std::min(kStraightDepth, limits_.depth);
    const bool last = straight || part.depth >= limits_.depth || verdict_.cells >= limits_.max_cells;
    // A whole motion is free more rarely than it collides in the middle.
    const bool pose_first = part.depth == 0 && !limits_.in_order && !last;
    if (pose_first && collides_at(part.middle(), part.open, false)) return false;
    const MotionCell cell = cells_.part(part.from, part.to);
    std::vector<Pair> rest = cell.wide ? part.open : not_apart(part, cell, last);
    // A part that turns far has no images, so it is no part of a proof although there is nothing to hit.
    if (rest.empty() && !(limits_.keep_parts && cell.wide)) {
      if (limits_.keep_parts) verdict_.parts.push_back({part.from, part.to});
      return true;
    }
    if ((!limits_.in_order && !pose_first) || last) {
      if (collides_at(part.middle(), rest, last && !straight && exact_tests_ < limits_.max_exact)) {
        verdict_.free_until = part.from;
        return false;
      }
    }
    if (straight) {
      const std::optional<bool> meets = meets_straight(part, rest);
      if (meets == true) verdict_.free_until = part.from;
      if (meets == false && limits_.keep_parts) verdict_.parts.push_back({part.from, part.to});
      if (meets) return !*meets;
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
    parts_.halve(part, std::move(rest));
    return true;
  }

  // The pairs of nodes that are not proved to be apart in a part of the motion.
  std::vector<Pair> not_apart(const Part& part, const MotionCell& cell, bool last) {
    placed_ = kNone;
    return nodes_not_apart(
        cell, checker_.robot_, checker_.obstacles_, part.open, last,
        [&](std::uint32_t robot, std::uint32_t obstacle) { return leaves_apart(part, cell, robot, obstacle); });
  }

  bool leaves_apart(const Part& part, const MotionCell& cell, std::uint32_t robot, std::uint32_t obstacle) {
    monitor_.check_interruption();
    const RigidBody::Piece& a = checker_.robot_.pieces()[robot];
    const RigidBody::Piece& b = checker_.obstacles_.pieces()[obstacle];
    place_robot(robot, cell);
    const Separation separation = plane_between(rough_robot_, checker_.rough_obstacles_[obstacle]);
    if (separation == Separation::kApart) return true;
    if (separation != Separation::kPerhaps || exact_tests_ >= limits_.max_exact) return false;
    // What touches in the closed sense is no case for smaller parts, but for the pose at which it does.
    if (closed(a, b)) return false;
    ++exact_tests_;
    const std::vector<Rational3> swept = cells_.exact_images(part.from, part.to, a.mesh.vertices);
    if (!hulls_are_apart(swept, b.mesh.vertices, false)) return false;
    verdict_.touches = true;
    return true;
  }

  // Whether one of the pairs of leaves collides in a part of a motion that does not turn, decided exactly; the verdict
  // says which. Nothing if that takes too many tests.
  std::optional<bool> meets_straight(const Part& part, const std::vector<Pair>& pairs) {
    for (const Pair& pair : pairs) {
      monitor_.check_interruption();
      if (exact_tests_ >= limits_.max_exact) return std::nullopt;
      ++exact_tests_;
      const std::uint32_t robot = checker_.robot_.nodes()[pair[0]].first;
      const std::uint32_t obstacle = checker_.obstacles_.nodes()[pair[1]].first;
      const RigidBody::Piece& a = checker_.robot_.pieces()[robot];
      const RigidBody::Piece& b = checker_.obstacles_.pieces()[obstacle];
      const std::vector<Rational3> swept = cells_.exact_images(part.from, part.to, a.mesh.vertices);
      const HullWitness witness = witness_of_hulls(swept, b.mesh.vertices, !closed(a, b));
      verdict_.touches = true;
      if (!witness.common) continue;
      // Images are those at both ends in turn, so the weights of the latter ones are the part that has passed.
      Rational passed = 0;
      for (std::size_t i = 1; motion_.moves() && i < swept.size(); i += 2) passed += witness.common->robot[i];
      const Rational from = exact_rational(part.from);
      tell_straight_collision(from + passed * (exact_rational(part.to) - from));
      verdict_.robot_piece = robot;
      verdict_.obstacle_piece = obstacle;
      return true;
    }
    return false;
  }

  // True if a pair collides at a pose; the verdict says which. Pairs that doubles leave open are decided exactly if
  // `exact`, else taken for free.
  bool collides_at(double s, const std::vector<Pair>& pairs, bool exact) {
    const MotionCell cell = cells_.pose(s);
    placed_ = kNone;
    return any_close_leaf(cell, checker_.robot_, checker_.obstacles_, pairs, [&](std::uint32_t a, std::uint32_t b) {
      if (!collide(s, cell, a, b, exact)) return false;
      tell_collision(s);
      verdict_.robot_piece = a;
      verdict_.obstacle_piece = b;
      return true;
    });
  }

  bool collide(double s, const MotionCell& cell, std::uint32_t robot, std::uint32_t obstacle, bool exact) {
    monitor_.check_interruption();
    const RigidBody::Piece& a = checker_.robot_.pieces()[robot];
    const RigidBody::Piece& b = checker_.obstacles_.pieces()[obstacle];
    place_robot(robot, cell);
    if (plane_between(rough_robot_, checker_.rough_obstacles_[obstacle]) == Separation::kApart) return false;
    keep_face_normals(a, cell, rough_robot_);
    placed_ = kNone;
    const bool between = s != 0 && s != 1;
    const double slack = between ? cells_.position_error() : 0;
    if (overlap(a, rough_robot_, b, slack) == Separation::kOverlapping) return true;
    // Where the position is not known exactly, neither is contact.
    if (!exact || slack > 0) return false;
    if (between) ++exact_tests_;
    const std::vector<Rational3> placed = cells_.exact_images(s, s, a.mesh.vertices);
    return !hulls_are_apart(placed, b.mesh.vertices, closed(a, b));
  }

  // Pairs come by pieces of the robot, mostly.
  void place_robot(std::uint32_t robot, const MotionCell& cell) {
    if (robot == placed_) return;
    place(checker_.robot_.pieces()[robot], cell, rough_robot_);
    placed_ = robot;
  }

  static constexpr std::uint32_t kNone = ~0U;

  const MotionChecker& checker_;
  const RigidMotion& motion_;
  MotionCells cells_;
  CheckLimits limits_;
  const Monitor& monitor_;
  MotionParts<std::vector<Pair>> parts_;
  std::size_t exact_tests_ = 0;
  MotionVerdict verdict_;
  RoughPolytope rough_robot_;
  std::uint32_t placed_ = kNone;  // the piece that it is, in the cell that is looked at
};

const char* status_name(MotionVerdict::Status status) {
  return std::array{"path", "blocked", "undecided"}.at(static_cast<std::size_t>(status));
}

MotionChecker::MotionChecker(RigidBody robot, RigidBody obstacles, ContactRule contact,
                             std::optional<std::array<Rational3, 2>> box)
    : robot_(std::move(robot)), obstacles_(std::move(obstacles)), contact_(contact), box_(std::move(box)) {
  rough_obstacles_.resize(obstacles_.pieces().size());
  for (std::size_t i = 0; i < rough_obstacles_.size(); ++i) place(obstacles_.pieces()[i], rough_obstacles_[i]);
}

MotionChecker MotionChecker::of_scene(const Scene& scene, const Monitor& monitor) {
  std::vector<RigidBody> obstacles;
  for (const Polyhedron& obstacle : scene.obstacles) {
    const Polyhedron reachable = reachable_part(obstacle, scene, monitor);
    if (!reachable.is_empty()) obstacles.push_back(RigidBody::of_set(closure(reachable, monitor), monitor));
  }
  return {RigidBody::of_set(closure(scene.robot, monitor), monitor), RigidBody::together(obstacles), scene.contact,
          scene.box};
}

MotionVerdict MotionChecker::check(const RigidPose& pose, const CheckLimits& limits, const Monitor& monitor) const {
  const RigidMotion still(pose, pose);
  MotionVerdict verdict;
  if (!in_box(pose.position)) {
    verdict.status = MotionVerdict::Status::kCollides;
    verdict.pose = pose;
    return verdict;
  }
  MotionExamination examination(*this, still, limits, monitor);
  examination.collides_at(0);
  return examination.take();
}

MotionVerdict MotionChecker::check(const RigidMotion& motion, const CheckLimits& limits, const Monitor& monitor) const {
  return MotionExamination(*this, motion, limits, monitor).run();
}

}  // namespace nef::planner
