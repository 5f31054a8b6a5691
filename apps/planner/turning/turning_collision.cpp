// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_collision.h"

#include <algorithm>
#include <limits>
#include <set>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/rigid/close_pieces.h"
#include "apps/planner/rigid/separation.h"
#include "apps/planner/turning/turning_robot.h"
#include "nef/construct/construct.h"

namespace nef::planner {

TurningCollision::TurningCollision(const Scene& scene, const TurningAxis& axis, const Monitor& monitor)
    : robot_(turning_robot(scene.robot)), axis_(axis), bodies_(MotionChecker::of_scene(scene, monitor)) {
  const std::vector<RigidBody::Piece>& obstacles = bodies_.obstacles().pieces();
  seams_ = scene.contact == ContactRule::kAllow && bodies_.robot().pieces().size() > 1 &&
           std::any_of(obstacles.begin(), obstacles.end(), [](const RigidBody::Piece& piece) { return piece.flat; });
}

bool TurningCollision::is_free(const Pose& pose) const {
  CheckLimits limits;
  limits.keep_pose = false;
  limits.surfaces_block = false;
  const RigidPose at = rigid(pose);
  return bodies_.check(at, limits).status == MotionVerdict::Status::kFree && !meets_surface({at, at});
}

bool TurningCollision::is_free(const Pose& from, const Pose& to, unsigned depth) const {
  const RigidMotion motion(rigid(from), rigid(to), MotionTiming::kSlerp);
  CheckLimits limits;
  limits.depth = depth;
  limits.keep_pose = false;
  // While it turns, what touches a surface between pieces is not known to be free.
  limits.surfaces_block = motion.turns() && seams_;
  if (!motion.turns()) limits.max_exact = std::numeric_limits<std::size_t>::max();
  if (bodies_.check(motion, limits).status != MotionVerdict::Status::kFree) return false;
  return motion.turns() || !meets_surface(motion);
}

bool TurningCollision::meets_surface(const RigidMotion& motion) const {
  if (!seams_) return false;
  const MotionCell way = MotionCells(motion).part(0, 1);
  RoughPolytope swept;
  RoughPolytope still;
  std::set<std::uint32_t> near;
  any_close_leaf(way, bodies_.robot(), bodies_.obstacles(), root_pair(bodies_.robot(), bodies_.obstacles()),
                 [&](std::uint32_t robot, std::uint32_t obstacle) {
                   const RigidBody::Piece& flat = bodies_.obstacles().pieces()[obstacle];
                   if (!flat.flat) return false;
                   place(bodies_.robot().pieces()[robot], way, swept);
                   place(flat, still);
                   if (plane_between(swept, still) != Separation::kApart) near.insert(obstacle);
                   return false;
                 });
  if (near.empty()) return false;
  AffineMap turn = AffineMap::identity();
  turn.linear = rotation_between(motion.from().quaternion, motion.from().quaternion);
  const Polyhedron inside = minkowski::minkowski_sum(interior(transform(robot_, turn)),
                                                     make_segment(motion.from().position, motion.to().position));
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t obstacle) {
    return !intersect(inside, convex_hull(bodies_.obstacles().pieces()[obstacle].mesh.vertices)).is_empty();
  });
}

}  // namespace nef::planner
