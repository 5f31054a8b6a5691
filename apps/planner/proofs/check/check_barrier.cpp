// SPDX-License-Identifier: Apache-2.0
//
// 1. Triangles whose edges occur an even number of times each are a cycle modulo 2: a path that does not meet it has
// both
//    ends on the same side, which a ray tells by the parity of its crossings.
// 2. Positions at which two convex pieces overlap are a convex set; if it has the corners of a triangle, it has all of
// it.
//    So is what lies beyond one side of the box.
// 3. A ray through an edge or a corner tells nothing: another direction is taken.
#include <algorithm>
#include <map>
#include <utility>

#include "apps/planner/proofs/check/check_parts.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {

namespace {

using BarrierComplaint = std::optional<std::string>;
using Corners = std::array<Rational3, 3>;

class BarrierCheck {
 public:
  explicit BarrierCheck(const PathProof& proof) : claim_(proof.claim), barrier_(*proof.barrier) {}

  BarrierComplaint run() {
    if (claim_.path.size() != 2) return "the path must be two poses, start and goal";
    for (const RigidPose& pose : claim_.path) {
      if (pose.quaternion != Quaternion{1, 0, 0, 0}) return "start and goal must not be turned";
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edges;
    std::vector<Corners> placed;
    for (std::size_t t = 0; t < barrier_.triangles.size(); ++t) {
      const PathProof::Triangle& triangle = barrier_.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        if (triangle.corners[k] >= barrier_.points.size()) return "a triangle names a point that does not exist";
        ++edges[std::minmax(triangle.corners[k], triangle.corners[(k + 1) % 3])];
      }
      if (!is_closed(triangle)) return "triangle " + std::to_string(t) + " can be crossed";
      placed.push_back(corners_of(triangle));
    }
    for (const auto& [edge, count] : edges) {
      if (count % 2 != 0) return "an edge belongs to an odd number of triangles";
    }
    const std::optional<bool> start = crosses_odd(placed, claim_.path.front().position);
    const std::optional<bool> goal = crosses_odd(placed, claim_.path.back().position);
    if (!start || !goal) return "no ray misses the edges, or start or goal is on the barrier";
    if (*start == *goal) return "start and goal are on the same side of the barrier";
    return std::nullopt;
  }

 private:
  [[nodiscard]] Corners corners_of(const PathProof::Triangle& triangle) const {
    return {barrier_.points[triangle.corners[0]], barrier_.points[triangle.corners[1]],
            barrier_.points[triangle.corners[2]]};
  }

  // Whether no position on the triangle is free.
  [[nodiscard]] bool is_closed(const PathProof::Triangle& triangle) const {
    const Corners corners = corners_of(triangle);
    if (!triangle.hit) return is_beyond_a_side(claim_.box, corners);
    const PathProof::Triangle::Hit& hit = *triangle.hit;
    if (hit.robot >= claim_.robot.size() || hit.obstacle >= claim_.obstacles.size()) return false;
    const std::vector<Rational3>& robot = claim_.robot[hit.robot];
    const std::vector<Rational3>& obstacle = claim_.obstacles[hit.obstacle];
    const bool open = claim_.contact == ContactRule::kAllow;
    if (open && (is_flat(robot) || is_flat(obstacle))) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = weighted_sum(robot, hit.common[k].robot, open);
      const auto b = weighted_sum(obstacle, hit.common[k].obstacle, open);
      if (!a || !b || minus(*b, *a) != corners[k]) return false;
    }
    return true;
  }

  const PathProof::Claim& claim_;
  const PathProof::Barrier& barrier_;
};

}  // namespace

std::optional<std::string> complaint_about_barrier(const PathProof& proof) { return BarrierCheck(proof).run(); }

}  // namespace nef::planner
