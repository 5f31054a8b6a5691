// SPDX-License-Identifier: Apache-2.0
//
// 1. The parts of each motion follow each other from 0 to 1.
// 2. Over a part, the images of a vertex by the rotations at both ends and by the mixed matrix between them
//    (rigid_motion.h), moved to both ends of an interval that holds the positions, enclose it.
// 3. Each pair of pieces has its boxes apart, or a plane of the proof between the images and the obstacle's vertices.
// 4. A collision is a common point of two pieces at both ends of an interval that holds the position. Pairs (position,
//    common point) of two convex pieces are a convex set, so there is one at the position itself.
// 5. What shows that a passage is tight is in check_tight.cpp; that its position is free, as in 3.
// 6. The pieces of a claim are the scene's sets if their unions are, those of the solid pieces and of the flat ones.
#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "apps/planner/proofs/check/arc_time.h"
#include "apps/planner/proofs/check/check_parts.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/proofs/rotation_claim.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using Points = std::vector<Rational3>;

// What does not hold; nothing if all does.
using Complaint = std::optional<std::string>;

Rational3 moved(const Matrix3& turn, const Rational3& v, const Rational3& position) {
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = dot(turn[k], v) + position[k];
  return result;
}

// The arc of one motion: between rotations that are the same, q is p.
struct Arc {
  Quaternion p;
  Quaternion q;
  Rational3 from;
  Rational3 to;
  bool turns = true;

  Arc(const RigidPose& a, const RigidPose& b) : p(a.quaternion), q(b.quaternion), from(a.position), to(b.position) {
    const Rational product = scalar_product(p, q);
    turns = product * product != scalar_product(p, p) * scalar_product(q, q);
    if (!turns) q = p;
    if (turns && product < 0) {
      for (Rational& x : q) x = -x;
    }
  }

  [[nodiscard]] Quaternion quaternion(const Rational& s) const {
    Quaternion result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = (1 - s) * p[k] + s * q[k];
    return result;
  }
  [[nodiscard]] std::array<Rational, 2> times(const Rational& s) const {
    return turns ? time_bounds(p, q, s) : std::array<Rational, 2>{s, s};
  }
  [[nodiscard]] Rational3 position(const Rational& time) const {
    Rational3 result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = (1 - time) * from[k] + time * to[k];
    return result;
  }
};

using Status = PathProof::Claim::Status;

class PathCheck {
 public:
  PathCheck(const PathProof& proof, const Monitor& monitor) : proof_(proof), claim_(proof.claim), monitor_(monitor) {}

  Complaint run() {
    if (Complaint complaint = check_shape()) return complaint;
    for (const Points& piece : claim_.robot) robot_flat_.push_back(is_flat(piece));
    for (const Points& piece : claim_.obstacles) obstacle_flat_.push_back(is_flat(piece));
    switch (claim_.status) {
      case Status::kFree:
        return check_free();
      case Status::kBlocked:
        return check_collision();
      case Status::kTight:
        return check_tight();
      default:
        if (proof_.layers) return complaint_about_layers(proof_, monitor_);
        return proof_.cells ? complaint_about_cells(proof_, monitor_) : complaint_about_barrier(proof_);
    }
  }

 private:
  [[nodiscard]] Complaint check_shape() const {
    if (claim_.path.empty()) return "the path has no pose";
    if (claim_.robot.empty()) return "the robot has no pieces";
    for (const ProofPieces* pieces : {&claim_.robot, &claim_.obstacles}) {
      if (std::any_of(pieces->begin(), pieces->end(), [](const Points& piece) { return piece.empty(); })) {
        return "a piece has no vertices";
      }
    }
    for (const RigidPose& pose : claim_.path) {
      if (scalar_product(pose.quaternion, pose.quaternion) == 0) return "the quaternion of a pose is zero";
    }
    if (claim_.status != Status::kFree && !proof_.motions.empty()) return "only the proof of a free path has motions";
    const int reasons = (proof_.collision ? 1 : 0) + (proof_.outside ? 1 : 0);
    if (reasons != (claim_.status == Status::kBlocked ? 1 : 0)) {
      return "the proof of a collision needs either a collision or a pose outside the box, and other proofs have "
             "neither";
    }
    if (claim_.rotations && claim_.status != Status::kInfeasible) return "only a claim of no path names rotations";
    const bool has_chain = claim_.rotations && !claim_.rotations->empty();
    if (claim_.places && !has_chain) return "only a chain of rotations has places";
    if (proof_.cells.has_value() != (claim_.rotations && !has_chain)) {
      return "the proof that there is no path of a robot that turns about all axes needs boxes of poses, and other "
             "proofs "
             "have none";
    }
    if (proof_.layers.has_value() != has_chain) {
      return "the proof that there is no path of a robot that turns about one axis needs layers, and other proofs have "
             "none";
    }
    if (proof_.barrier.has_value() != (claim_.status == Status::kInfeasible && !claim_.rotations)) {
      return "the proof that there is no path needs a barrier, and other proofs have none";
    }
    const std::size_t places = claim_.status == Status::kTight ? claim_.path.size() : 0;
    if (proof_.tight.size() != places || claim_.along.size() != places) {
      return "the proof that passages are tight needs its vectors and cones for each pose, and other proofs have none";
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t motion_count() const { return std::max<std::size_t>(claim_.path.size() - 1, 1); }
  [[nodiscard]] Arc arc(std::size_t motion) const {
    return {claim_.path[motion], claim_.path[std::min(motion + 1, claim_.path.size() - 1)]};
  }
  [[nodiscard]] bool in_box(const Rational3& position) const {
    if (!claim_.box) return true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (position[k] < (*claim_.box)[0][k] || position[k] > (*claim_.box)[1][k]) return false;
    }
    return true;
  }
  // Whether two pieces may touch.
  [[nodiscard]] bool may_touch(std::size_t i, std::size_t j) const {
    return claim_.contact == ContactRule::kAllow && !robot_flat_[i] && !obstacle_flat_[j];
  }

  Complaint check_free() {
    for (const RigidPose& pose : claim_.path) {
      if (!in_box(pose.position)) return "a pose is outside the box";
    }
    if (proof_.motions.size() != motion_count()) return "the proof needs one list of parts per motion";
    for (std::size_t m = 0; m < proof_.motions.size(); ++m) {
      const Arc motion = arc(m);
      Rational from = 0;
      for (const PathProof::Part& part : proof_.motions[m]) {
        const std::string where = "motion " + std::to_string(m) + ", part until " + to_string(part.until) + ": ";
        if (part.until <= from || part.until > 1) return where + "parts must go up to 1";
        if (Complaint complaint = check_part(motion, from, part)) return where + *complaint;
        from = part.until;
      }
      if (from != 1) return "the parts of motion " + std::to_string(m) + " do not go up to 1";
    }
    return std::nullopt;
  }

  Complaint check_part(const Arc& motion, const Rational& from, const PathProof::Part& part) const {
    std::map<std::pair<std::size_t, std::size_t>, Rational3> planes;
    for (const PathProof::Plane& plane : part.planes) {
      if (plane.robot >= claim_.robot.size() || plane.obstacle >= claim_.obstacles.size()) {
        return "a plane names a piece that does not exist";
      }
      planes[{plane.robot, plane.obstacle}] = plane.normal;
    }
    const Quaternion p = motion.quaternion(from);
    const Quaternion q = motion.quaternion(part.until);
    if (scalar_product(p, q) <= 0) return "the motion turns too far";
    const std::array<Matrix3, 3> turns{rotation_between(p, p), rotation_between(p, q), rotation_between(q, q)};
    const std::array<Rational3, 2> positions{motion.position(motion.times(from)[0]),
                                             motion.position(motion.times(part.until)[1])};
    for (std::size_t i = 0; i < claim_.robot.size(); ++i) {
      Points swept;
      for (const Rational3& v : claim_.robot[i]) {
        for (const Matrix3& turn : turns) {
          for (const Rational3& position : positions) swept.push_back(moved(turn, v, position));
        }
      }
      for (std::size_t j = 0; j < claim_.obstacles.size(); ++j) {
        const auto plane = planes.find({i, j});
        if (are_apart(swept, claim_.obstacles[j], may_touch(i, j), plane == planes.end() ? nullptr : &plane->second)) {
          continue;
        }
        return "nothing separates piece " + std::to_string(i) + " of the robot from piece " + std::to_string(j) +
               " of the obstacles";
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] Complaint check_tight() const {
    if (claim_.contact != ContactRule::kAllow) return "without contact no passage is tight";
    for (std::size_t i = 0; i < claim_.path.size(); ++i) {
      const RigidPose& pose = claim_.path[i];
      if (pose.quaternion != Quaternion{1, 0, 0, 0}) return "a pose in a tight passage must not be turned";
      if (!in_box(pose.position)) return "a pose is outside the box";
      const std::string where = "pose " + std::to_string(i) + ": ";
      if (Complaint complaint = check_part({pose, pose}, 0, {1, proof_.tight[i].planes})) return where + *complaint;
      if (Complaint complaint = complaint_about_tight(proof_, i)) return where + *complaint;
    }
    return std::nullopt;
  }

  static bool are_apart(const Points& a, const Points& b, bool may_touch, const Rational3* plane) {
    const auto between = [&](const std::function<Rational(const Rational3&)>& height) {
      Rational top = height(a.front());
      for (const Rational3& p : a) top = std::max(top, height(p));
      return std::all_of(b.begin(), b.end(), [&](const Rational3& p) {
        const Rational at = height(p);
        return at > top || (may_touch && at == top);
      });
    };
    for (std::size_t k = 0; k < 3; ++k) {
      if (between([k](const Rational3& p) { return p[k]; })) return true;
      if (between([k](const Rational3& p) { return Rational(-p[k]); })) return true;
    }
    return plane != nullptr && !is_zero(*plane) && between([plane](const Rational3& p) { return dot(*plane, p); });
  }

  [[nodiscard]] Complaint check_collision() const {
    if (proof_.outside) {
      if (*proof_.outside >= claim_.path.size()) return "the pose outside the box does not exist";
      if (in_box(claim_.path[*proof_.outside].position)) return "the pose that should be outside the box is inside";
      return std::nullopt;
    }
    const PathProof::Collision& c = *proof_.collision;
    if (c.motion >= motion_count()) return "the motion of the collision does not exist";
    if (c.robot >= claim_.robot.size() || c.obstacle >= claim_.obstacles.size())
      return "a piece of the collision does not exist";
    if (c.parameter < 0 || c.parameter > 1) return "the parameter is not between 0 and 1";
    const Arc motion = arc(c.motion);
    const std::array<Rational, 2> known = motion.times(c.parameter);
    if (c.times[0] > known[0] || c.times[1] < known[1]) return "the position is not where the proof says";
    const Quaternion q = motion.quaternion(c.parameter);
    const Matrix3 turn = rotation_between(q, q);
    for (std::size_t end = 0; end < 2; ++end) {
      Points placed;
      for (const Rational3& v : claim_.robot[c.robot]) {
        placed.push_back(moved(turn, v, motion.position(c.times[end])));
      }
      const bool inside = may_touch(c.robot, c.obstacle);
      const auto a = weighted_sum(placed, c.common[end].robot, inside);
      const auto b = weighted_sum(claim_.obstacles[c.obstacle], c.common[end].obstacle, inside);
      if (!a || !b) return "weights must be positive and add up to 1";
      if (*a != *b) return "the point of the collision is not common to the pieces";
    }
    return std::nullopt;
  }

  const PathProof& proof_;
  const PathProof::Claim& claim_;
  const Monitor& monitor_;
  std::vector<bool> robot_flat_;
  std::vector<bool> obstacle_flat_;
};

// The union of the pieces that are flat, or of those that are not.
Polyhedron united(const ProofPieces& pieces, bool flat, const Monitor& monitor) {
  std::vector<Polyhedron> hulls;
  for (const Points& piece : pieces) {
    if (is_flat(piece) == flat) hulls.push_back(convex_hull(piece, monitor));
  }
  return unite_all(hulls, monitor);
}

// Compares the solid pieces with the solid parts of sets, and the flat ones with what sticks out of these.
Complaint compare(const ProofPieces& pieces, const std::vector<Polyhedron>& sets, const std::string& what,
                  const Monitor& monitor) {
  std::vector<Polyhedron> solid;
  std::vector<Polyhedron> rest;
  for (const Polyhedron& set : sets) {
    solid.push_back(regularize(set, monitor));
    rest.push_back(closure(subtract(set, solid.back(), monitor), monitor));
  }
  for (const bool flat : {false, true}) {
    if (equal(united(pieces, flat, monitor), unite_all(flat ? rest : solid, monitor))) continue;
    return std::string("the ") + (flat ? "flat" : "solid") + " pieces of the " + what + " are not those of the scene";
  }
  return std::nullopt;
}

// Whether a claim that there is no path is about the rotations of the scene, and, if it has some, about its start and
// goal.
Complaint compare_rotations(const PathProof::Claim& claim, const Scene& scene) {
  if (claim.rotations.has_value() == scene.only_translates()) {
    return claim.rotations ? "the robot of the scene does not turn" : "the robot of the scene may turn";
  }
  if (!claim.rotations) return std::nullopt;
  const RotationClaim meant = rotation_claim_of(scene);
  if (*claim.rotations != meant.chain || claim.places != meant.places) {
    return "the robot of the scene has other rotations";
  }
  const auto same = [](const RigidPose& a, const RigidPose& b) {
    return a.position == b.position && a.quaternion == b.quaternion;
  };
  if (claim.path.size() != 2 || !same(claim.path.front(), meant.start) || !same(claim.path.back(), meant.goal)) {
    return "the scene has another start or goal";
  }
  return std::nullopt;
}

}  // namespace

Complaint complaint_about(const PathProof& proof, const Monitor& monitor) { return PathCheck(proof, monitor).run(); }

Complaint complaint_about(const PathProof::Claim& claim, const Scene& scene, const Monitor& monitor) {
  if (claim.contact != scene.contact) return "the scene has a different contact rule";
  if (claim.box != scene.box) return "the scene has a different box";
  const bool turned = std::any_of(claim.path.begin(), claim.path.end(), [](const RigidPose& pose) {
    return pose.quaternion[1] != 0 || pose.quaternion[2] != 0 || pose.quaternion[3] != 0;
  });
  if (claim.status == Status::kInfeasible) {
    if (Complaint complaint = compare_rotations(claim, scene)) return complaint;
  }
  // A robot that turns about one axis is meant as it is in the scene.
  const bool as_in_file = turned && !(claim.rotations && scene.rotation);
  const Scene meant = as_in_file ? with_robot_as_in_its_file(scene, monitor) : scene;
  if (Complaint complaint = compare(claim.robot, {closure(meant.robot, monitor)}, "robot", monitor)) return complaint;
  std::vector<Polyhedron> obstacles;
  for (const Polyhedron& obstacle : meant.obstacles) {
    obstacles.push_back(closure(reachable_part(obstacle, meant, monitor), monitor));
  }
  return compare(claim.obstacles, obstacles, "obstacles", monitor);
}

}  // namespace nef::planner
