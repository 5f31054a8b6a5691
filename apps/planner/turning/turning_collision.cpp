// SPDX-License-Identifier: Apache-2.0
//
// For each pair of pieces whose boxes come close, both swept over the motion: a plane between them, found in doubles,
// says that they are apart; if none comes close, a pose at which they surely overlap proves a collision; otherwise the
// exact hull of differences decides. A motion that turns is halved, and pairs that are not apart go to both halves,
// until none is left or the depth is used up.
#include "apps/planner/turning/turning_collision.h"

#include <algorithm>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/rigid/separation.h"
#include "apps/planner/turning/turning_robot.h"
#include "nef/construct/construct.h"

namespace nef::planner {

TurningCollision::TurningCollision(const Scene& scene, const TurningAxis& axis, const Monitor& monitor)
    : robot_(turning_robot(scene.robot)),
      axis_(axis),
      bodies_(MotionChecker::of_scene(scene, monitor)),
      closed_(scene.contact == ContactRule::kForbid) {}

bool TurningCollision::surely_hits(const MotionCells& cells, const RigidBody::Piece& a, const RigidBody::Piece& b) {
  RoughPolytope placed;
  for (const double s : {0.5, 0.25, 0.75}) {
    const MotionCell pose = cells.pose(s);
    place(a, pose, placed);
    keep_face_normals(a, pose, placed);
    if (overlap(a, placed, b, 0) == Separation::kOverlapping) return true;
    if (!cells.motion().moves()) return false;
  }
  return false;
}

bool TurningCollision::is_free_straight(const RigidMotion& motion, const std::vector<NodePair>& pairs) const {
  if (!bodies_.in_box(motion.from().position) || !bodies_.in_box(motion.to().position)) return false;
  const MotionCells cells(motion);
  const MotionCell way = cells.part(0, 1);
  RoughPolytope swept;
  RoughPolytope still;
  std::vector<const RigidBody::Piece*> touched;
  const auto hit = [&](std::uint32_t robot, std::uint32_t obstacle) {
    const RigidBody::Piece& a = bodies_.robot().pieces()[robot];
    const RigidBody::Piece& b = bodies_.obstacles().pieces()[obstacle];
    place(a, way, swept);
    place(b, still);
    const Separation plane = plane_between(swept, still);
    if (plane == Separation::kApart) return false;
    if (plane == Separation::kUnknown && surely_hits(cells, a, b)) return true;
    if (!hulls_are_apart(cells.exact_images(0, 1, a.mesh.vertices), b.mesh.vertices, closed_)) return true;
    if (b.flat) touched.push_back(&b);
    return false;
  };
  if (any_close_leaf(way, bodies_.robot(), bodies_.obstacles(), pairs, hit)) return false;
  // What is flat may lie where pieces of the robot meet, on the borders of these and inside the robot.
  if (bodies_.robot().pieces().size() == 1 || closed_) return true;
  return std::none_of(touched.begin(), touched.end(),
                      [&](const RigidBody::Piece* flat) { return meets_flat(*flat, motion); });
}

bool TurningCollision::meets_flat(const RigidBody::Piece& flat, const RigidMotion& motion) const {
  AffineMap turn = AffineMap::identity();
  turn.linear = rotation_between(motion.from().quaternion, motion.from().quaternion);
  const Polyhedron swept = minkowski::minkowski_sum(interior(transform(robot_, turn)),
                                                    make_segment(motion.from().position, motion.to().position));
  return !intersect(swept, convex_hull(flat.mesh.vertices)).is_empty();
}

bool TurningCollision::is_free(const Pose& from, const Pose& to, int depth) const {
  const std::vector<NodePair> all = root_pair(bodies_.robot(), bodies_.obstacles());
  if (from.turn == to.turn) return is_free_straight({rigid(from), rigid(to)}, all);
  if (!is_free(to) || !bodies_.in_box(from.position)) return false;
  const RigidMotion motion(rigid(from), rigid(to), MotionTiming::kSlerp);
  return surely_free(MotionCells(motion), 0, 1, all, depth);
}

bool TurningCollision::surely_free(const MotionCells& cells, double from, double to, std::vector<NodePair> pairs,
                                   int depth) const {
  const MotionCell cell = cells.part(from, to);
  if (!cell.wide) {
    RoughPolytope swept;
    RoughPolytope still;
    bool refused = false;  // then the others need not be looked at exactly
    const auto leaf_apart = [&](std::uint32_t robot, std::uint32_t obstacle) {
      const RigidBody::Piece& a = bodies_.robot().pieces()[robot];
      const RigidBody::Piece& b = bodies_.obstacles().pieces()[obstacle];
      place(a, cell, swept);
      place(b, still);
      const Separation plane = plane_between(swept, still);
      if (plane == Separation::kApart) return true;
      // What slides along a floor as it turns is free, too.
      const bool sure_contact = !b.flat || bodies_.robot().pieces().size() == 1;
      refused = refused || plane == Separation::kUnknown || !sure_contact ||
                !hulls_are_apart(cells.exact_images(from, to, a.mesh.vertices), b.mesh.vertices, closed_);
      return !refused;
    };
    pairs = nodes_not_apart(cell, bodies_.robot(), bodies_.obstacles(), std::move(pairs), true, leaf_apart);
    if (pairs.empty()) return true;
  }
  if (depth == 0) return false;
  const double middle = (from + to) / 2;
  const RigidPose pose = cells.motion().at(middle);
  return is_free_straight({pose, pose}, pairs) && surely_free(cells, from, middle, pairs, depth - 1) &&
         surely_free(cells, middle, to, pairs, depth - 1);
}

}  // namespace nef::planner
