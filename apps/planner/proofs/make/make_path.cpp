// SPDX-License-Identifier: Apache-2.0
//
// The search has left the parts of each motion in which all pairs of pieces are apart, as enclosed by MotionCells. For
// each pair whose exact boxes are not, a plane is looked for in doubles first (rounded, and verified exactly), and then
// by a linear program. Of a collision the two pieces and the pose are known; the program gives the common point.
#include <algorithm>
#include <cmath>

#include "apps/planner/intersection/common_point.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/rigid/separation.h"
#include "nef/base/error.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using Points = std::vector<Rational3>;

// How a motion scales the quaternions of a claim: parameters of its arc and of the claim's are not the same.
Rational scale_between(const Quaternion& given, const Quaternion& used) {
  const auto k = static_cast<std::size_t>(
      std::find_if(given.begin(), given.end(), [](const Rational& x) { return x != 0; }) - given.begin());
  return abs(used[k] / given[k]);
}

// A box of exact points.
std::array<Rational3, 2> box_of(const Points& points) {
  std::array<Rational3, 2> box{points.front(), points.front()};
  for (const Rational3& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] = std::min(box[0][k], p[k]);
      box[1][k] = std::max(box[1][k], p[k]);
    }
  }
  return box;
}

bool boxes_apart(const std::array<Rational3, 2>& a, const std::array<Rational3, 2>& b, bool may_touch) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a[1][k] < b[0][k] || b[1][k] < a[0][k]) return true;
    if (may_touch && (a[1][k] == b[0][k] || b[1][k] == a[0][k])) return true;
  }
  return false;
}

bool separates(const Rational3& normal, const Points& a, const Points& b, bool may_touch) {
  if (is_zero(normal)) return false;
  Rational top = dot(normal, a.front());
  for (const Rational3& p : a) top = std::max(top, dot(normal, p));
  return std::all_of(b.begin(), b.end(), [&](const Rational3& p) {
    const Rational at = dot(normal, p);
    return at > top || (may_touch && at == top);
  });
}

// With few binary places, if those separate, too.
std::optional<Rational3> rounded_normal(const Vector3d& found, const Points& a, const Points& b, bool may_touch) {
  for (const double places : {0x1p5, 0x1p12, 0x1p40}) {
    Rational3 normal;
    for (std::size_t k = 0; k < 3; ++k) {
      normal[k] = exact_rational(std::nearbyint(found[static_cast<Eigen::Index>(k)] * places));
    }
    if (separates(normal, a, b, may_touch)) return to_rational(primitive(normal));
  }
  return std::nullopt;
}

class PathProver {
 public:
  PathProver(const MotionChecker& checker, std::span<const RigidPose> poses, const CertifiedPath& known,
             const Monitor& monitor)
      : checker_(checker), known_(known), monitor_(monitor) {
    proof_.claim.status = known.status == MotionVerdict::Status::kFree ? PathProof::Claim::Status::kFree
                                                                       : PathProof::Claim::Status::kBlocked;
    proof_.claim.contact = checker.contact();
    proof_.claim.box = checker.box();
    for (const RigidBody::Piece& piece : checker.robot().pieces()) proof_.claim.robot.push_back(piece.mesh.vertices);
    for (const RigidBody::Piece& piece : checker.obstacles().pieces()) {
      proof_.claim.obstacles.push_back(piece.mesh.vertices);
      boxes_.push_back(box_of(piece.mesh.vertices));
    }
    proof_.claim.path.assign(poses.begin(), poses.end());
  }

  PathProof run() {
    if (proof_.claim.status == PathProof::Claim::Status::kBlocked) {
      prove_collision();
      return std::move(proof_);
    }
    for (std::size_t m = 0; m < known_.motions.size(); ++m) {
      monitor_.tell_progress("proving motions", m, known_.motions.size());
      const RigidMotion motion = this->motion(m);
      const MotionCells cells(motion);
      std::vector<PathProof::Part>& parts = proof_.motions.emplace_back();
      for (const std::array<double, 2>& part : known_.motions[m].parts) {
        parts.push_back({parameter(m, motion, part[1]), planes_of(cells, part)});
      }
    }
    return std::move(proof_);
  }

 private:
  [[nodiscard]] RigidMotion motion(std::size_t m) const {
    const std::vector<RigidPose>& path = proof_.claim.path;
    return {path[m], path[std::min(m + 1, path.size() - 1)], MotionTiming::kSlerp};
  }

  // The parameter of the claim's arc.
  [[nodiscard]] Rational parameter(std::size_t m, const RigidMotion& motion, double s) const {
    Rational at = exact_rational(s);
    if (!motion.turns()) return at;
    const std::vector<RigidPose>& path = proof_.claim.path;
    const Rational near = (1 - at) * scale_between(path[m].quaternion, motion.from().quaternion);
    const Rational far = at * scale_between(path[m + 1].quaternion, motion.to().quaternion);
    return far / (near + far);
  }

  [[nodiscard]] bool may_touch(std::size_t i, std::size_t j) const {
    return proof_.claim.contact == ContactRule::kAllow && !checker_.robot().pieces()[i].flat &&
           !checker_.obstacles().pieces()[j].flat;
  }

  [[nodiscard]] std::vector<PathProof::Plane> planes_of(const MotionCells& cells,
                                                        const std::array<double, 2>& part) const {
    std::vector<PathProof::Plane> planes;
    const MotionCell cell = cells.part(part[0], part[1]);
    for (std::uint32_t i = 0; i < proof_.claim.robot.size(); ++i) {
      monitor_.check_interruption();
      const Points swept = cells.exact_images(part[0], part[1], proof_.claim.robot[i]);
      const std::array<Rational3, 2> box = box_of(swept);
      for (std::uint32_t j = 0; j < proof_.claim.obstacles.size(); ++j) {
        if (boxes_apart(box, boxes_[j], may_touch(i, j))) continue;
        planes.push_back({i, j, plane_between_pieces(cell, swept, i, j)});
      }
    }
    return planes;
  }

  [[nodiscard]] Rational3 plane_between_pieces(const MotionCell& cell, const Points& swept, std::uint32_t i,
                                               std::uint32_t j) const {
    const Points& obstacle = proof_.claim.obstacles[j];
    Vector3d direction = Vector3d::Zero();
    RoughPolytope a;
    RoughPolytope b;
    place(checker_.robot().pieces()[i], cell, a);
    place(checker_.obstacles().pieces()[j], b);
    if (plane_between(a, b, &direction) == Separation::kApart) {
      if (const auto normal = rounded_normal(direction, swept, obstacle, may_touch(i, j))) return *normal;
    }
    const HullWitness witness = witness_of_hulls(swept, obstacle, may_touch(i, j));
    NEF_ASSERT(!witness.common);  // the search has found them apart in this part or in one that holds it
    return to_rational(primitive(witness.normal));
  }

  void prove_collision() {
    const std::size_t m = *known_.blocked;
    const MotionVerdict& verdict = known_.motions[m];
    for (const std::size_t end : {m, std::min(m + 1, proof_.claim.path.size() - 1)}) {
      if (!checker_.in_box(proof_.claim.path[end].position)) {
        proof_.outside = end;
        return;
      }
    }
    const RigidMotion motion = this->motion(m);
    const MotionCells cells(motion);
    PathProof::Collision collision;
    collision.motion = m;
    collision.parameter = parameter(m, motion, verdict.parameter);
    collision.robot = verdict.robot_piece;
    collision.obstacle = verdict.obstacle_piece;
    const bool inside = may_touch(verdict.robot_piece, verdict.obstacle_piece);
    const bool at_end = verdict.parameter == 0 || verdict.parameter == 1;
    if (!motion.turns()) {
      prove_straight_collision(motion, *verdict.pose, std::move(collision), inside);
      return;
    }
    const std::array<double, 2> times =
        at_end ? std::array{verdict.parameter, verdict.parameter} : cells.times(verdict.parameter, verdict.parameter);
    for (std::size_t end = 0; end < 2; ++end) {
      collision.times[end] = exact_rational(times[end]);
      const Points placed =
          cells.exact_images_at(verdict.parameter, times[end], proof_.claim.robot[verdict.robot_piece]);
      HullWitness witness = witness_of_hulls(placed, proof_.claim.obstacles[verdict.obstacle_piece], inside);
      NEF_ASSERT(witness.common);
      collision.common[end] = *std::move(witness.common);
    }
    proof_.collision = std::move(collision);
  }

  // Where the motion does not turn the pose is exact, and says when it is.
  void prove_straight_collision(const RigidMotion& motion, const RigidPose& pose, PathProof::Collision collision,
                                bool inside) {
    const Rational3 way = minus(motion.to().position, motion.from().position);
    const Rational3 gone = minus(pose.position, motion.from().position);
    if (motion.moves()) collision.parameter = dot(gone, way) / dot(way, way);
    Points placed;
    for (const Rational3& v : proof_.claim.robot[collision.robot]) placed.push_back(map_of(pose)(v));
    HullWitness witness = witness_of_hulls(placed, proof_.claim.obstacles[collision.obstacle], inside);
    NEF_ASSERT(witness.common);
    collision.times.fill(collision.parameter);
    collision.common.fill(*witness.common);
    proof_.collision = std::move(collision);
  }

  const MotionChecker& checker_;
  const CertifiedPath& known_;
  const Monitor& monitor_;
  std::vector<std::array<Rational3, 2>> boxes_;  // of the obstacles' pieces
  PathProof proof_;
};

}  // namespace

std::optional<PathProof> make_path_proof(const MotionChecker& checker, std::span<const RigidPose> poses,
                                         const CertifiedPath& known, const Monitor& monitor) {
  if (known.status == MotionVerdict::Status::kUndecided) return std::nullopt;
  return PathProver(checker, poses, known, monitor).run();
}

std::optional<PathProof> make_path_proof(const MotionChecker& checker, std::span<const RigidPose> poses,
                                         const Monitor& monitor) {
  CheckLimits limits;
  limits.keep_parts = true;
  return make_path_proof(checker, poses, certify(checker, poses, MotionTiming::kSlerp, limits, monitor), monitor);
}

}  // namespace nef::planner
