// SPDX-License-Identifier: Apache-2.0
//
// 1. Let K be the inner robot's free positions in a cell of angles that are on one side (joined to the start, or not),
//    and R the sum of K and a cube smaller than the distance from K to the other ones. No position on the boundary of R
//    is free for the inner robot, so none is free at any angle of the cell.
// 2. Let a be the angle between two cells. The robot's free positions at a are in K for both cells, or in neither K, so
//    they are in both R, or in neither. What only one R has is blocked at a. It is decomposed into convex cells, and
//    these into tetrahedra.
// 3. The positions at which a pair of pieces overlaps are an open set, and these sets cover both, so halving triangles
//    and tetrahedra along their longest edges comes to an end. Pairs are found in doubles, and all is checked exactly
//    afterwards.
#include "apps/planner/no_path/turning_barrier.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/no_rigid_path.h"
#include "apps/planner/no_path/pose_cover.h"
#include "apps/planner/proofs/check/check_parts.h"
#include "apps/planner/proofs/rotation_claim.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/turning/turning_robot.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/distance/distance.h"
#include "nef/export/to_mesh.h"
#include "nef/geometry/vectors.h"
#include "nef/parts/split.h"

namespace nef::planner {
namespace {

using SimplexCorners = std::vector<Rational3>;

// The inner robot's free positions in a cell of angles.
struct Sides {
  Polyhedron start;  // components that are joined to the start
  Polyhedron other;
};

// The sides of each cell of a proof.
std::vector<Sides> sides_of(const Scene& scene, const TurningProof& found, const Monitor& monitor) {
  const minkowski::FixedObstacles obstacles = fixed_obstacles(scene, monitor);
  std::vector<Sides> result;
  for (const TurningProof::Cell& cell : found.cells) {
    std::vector<Mesh> robot;
    for (const std::vector<Rational3>& piece : cell.inner) robot.push_back(convex_hull_mesh(piece, monitor));
    std::array<std::vector<Polyhedron>, 2> parts;
    for (const Polyhedron& component : split(obstacles.free_positions(robot, monitor), monitor)) {
      const bool joined = std::any_of(cell.start_side.begin(), cell.start_side.end(),
                                      [&](const Rational3& point) { return contains(component, point); });
      parts[joined ? 0 : 1].push_back(component);
    }
    result.push_back({unite_all(parts[0], monitor), unite_all(parts[1], monitor)});
  }
  return result;
}

// Half a side of a cube for the sum: a power of two, at most a quarter of the distance, and not large beside the robot.
// Nothing without a distance.
std::optional<Rational> margin_between(const Sides& sides, double reach, const Monitor& monitor) {
  double most = reach / 2;  // if one side is empty, any margin will do
  if (!sides.start.is_empty() && !sides.other.is_empty()) {
    const std::optional<Distance> gap = distance(sides.start, sides.other, monitor);
    if (!gap || gap->squared == 0) return std::nullopt;
    most = std::min(most, std::sqrt(nearest_double(gap->squared)));
  }
  return exact_rational(std::exp2(std::floor(std::log2(most / 4))));
}

// The sum of each cell's bounded side and a cube; nothing if the sides have no distance somewhere. `reach`: how far the
// robot's farthest point is from its origin.
std::optional<std::vector<Polyhedron>> enclosures_of(const std::vector<Sides>& cells, double reach,
                                                     const Monitor& monitor) {
  const bool take_start =
      std::all_of(cells.begin(), cells.end(), [](const Sides& sides) { return sides.start.is_bounded(); });
  std::vector<Polyhedron> result;
  for (const Sides& sides : cells) {
    const std::optional<Rational> margin = margin_between(sides, reach, monitor);
    const Polyhedron& side = take_start ? sides.start : sides.other;
    if (!margin || !side.is_bounded()) return std::nullopt;
    const Rational& r = *margin;
    minkowski::MinkowskiOptions options;
    options.monitor = monitor;
    result.push_back(side.is_empty() ? side
                                     : minkowski::minkowski_sum(closure(side, monitor),
                                                                make_box({-r, -r, -r}, {r, r, r}, monitor), options));
  }
  return result;
}

std::vector<SimplexCorners> triangles_of(const Polyhedron& set, const Monitor& monitor) {
  const Mesh mesh = to_mesh(set, {}, monitor).mesh;
  std::vector<SimplexCorners> result;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto ring = mesh.face(f);
    result.push_back({mesh.vertices[ring[0]], mesh.vertices[ring[1]], mesh.vertices[ring[2]]});
  }
  return result;
}

// Each convex cell from its first vertex.
std::vector<SimplexCorners> tetrahedra_of(const Polyhedron& set, const Monitor& monitor) {
  std::vector<SimplexCorners> result;
  for (const minkowski::ConvexCell& cell : minkowski::decompose(closure(set, monitor), monitor)) {
    if (cell.dimension < 3) continue;
    const std::vector<Rational3>& v = cell.mesh.vertices;
    for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
      const auto ring = cell.mesh.face(f);
      if (std::find(ring.begin(), ring.end(), 0U) != ring.end()) continue;
      for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
        result.push_back({v[0], v[ring[0]], v[ring[k]], v[ring[k + 1]]});
      }
    }
  }
  return result;
}

// Cuts simplices until each of them is blocked.
class SimplexCutter {
 public:
  SimplexCutter(PathProof& proof, const BlockingPairs& pairs, const Monitor& monitor)
      : claim_(proof.claim), points_(proof.layers->points), pairs_(pairs), monitor_(monitor) {}

  // False if that takes too many parts.
  bool cut(const std::vector<SimplexCorners>& simplices, const OrientationBox<Rational>& orientations,
           std::vector<PathProof::BlockedSimplex>& blocked) {
    OrientationBox<double> rough;
    rough.chart = orientations.chart;
    rough.low[0] = nearest_double(orientations.low[0]);
    rough.high[0] = nearest_double(orientations.high[0]);
    const TurnedRobot robot = pairs_.turned(rough);
    std::vector<Open> open;
    for (const SimplexCorners& simplex : simplices) open.push_back({simplex, pairs_.all()});
    while (!open.empty()) {
      monitor_.check_interruption();
      if (left_ == 0) return false;
      --left_;
      Open next = std::move(open.back());
      open.pop_back();
      if (std::optional<PathProof::BlockedSimplex> done = blocked_at_once(next, robot)) {
        blocked.push_back(*std::move(done));
      } else {
        halve(next, open);
      }
    }
    return true;
  }

 private:
  struct Open {
    SimplexCorners corners;
    std::vector<BlockingPairs::Pair> pairs;  // that may overlap there
  };

  std::optional<PathProof::BlockedSimplex> blocked_at_once(Open& simplex, const TurnedRobot& robot) {
    PathProof::BlockedSimplex result;
    if (!is_beyond_a_side(claim_.box, simplex.corners)) {
      std::vector<Vector3d> corners;
      for (const Rational3& corner : simplex.corners) corners.push_back(to_vector(corner));
      PositionBox box{corners.front(), corners.front()};
      for (const Vector3d& corner : corners) {
        box.low = box.low.cwiseMin(corner);
        box.high = box.high.cwiseMax(corner);
      }
      std::erase_if(simplex.pairs, [&](const BlockingPairs::Pair& pair) { return !pairs_.may_meet(pair, box); });
      for (const BlockingPairs::Pair& pair : simplex.pairs) {
        std::vector<Rational3> common = common_points(pairs_, pair, robot, corners);
        if (common.empty()) continue;
        result.hit = {pair[0], pair[1], std::move(common)};
        break;
      }
      if (!result.hit) return std::nullopt;
    }
    for (const Rational3& corner : simplex.corners) result.corners.push_back(number_of(corner));
    return result;
  }

  static void halve(const Open& simplex, std::vector<Open>& open) {
    std::array<std::size_t, 2> longest{0, 1};
    Rational length = -1;
    for (std::size_t j = 1; j < simplex.corners.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const Rational3 along = minus(simplex.corners[i], simplex.corners[j]);
        Rational square = dot(along, along);
        if (square <= length) continue;
        length = std::move(square);
        longest = {i, j};
      }
    }
    const Rational3& a = simplex.corners[longest[0]];
    const Rational3& b = simplex.corners[longest[1]];
    const Rational3 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    for (const std::size_t end : longest) {
      Open& half = open.emplace_back(simplex);
      half.corners[end] = middle;
    }
  }

  std::uint32_t number_of(const Rational3& point) {
    const auto [at, is_new] = numbers_.try_emplace(point, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(point);
    return at->second;
  }

  const PathProof::Claim& claim_;
  std::vector<Rational3>& points_;
  const BlockingPairs& pairs_;
  std::size_t left_ = 100000;
  Monitor monitor_;
  std::map<Rational3, std::uint32_t> numbers_;
};

// The parameter of a quaternion in a chart that goes from one quaternion to another one: it is proportional to
// (1 - s) p + s q, and the parameter is 2 s - 1.
Rational chain_parameter_of(const Quaternion& at, const Quaternion& p, const Quaternion& q) {
  for (std::size_t k = 1; k < 4; ++k) {
    const auto area = [&](const Quaternion& a, const Quaternion& b) -> Rational { return a[0] * b[k] - a[k] * b[0]; };
    if (area(p, q) == 0) continue;
    const Rational s = area(p, at) / (area(p, at) + area(at, q));
    return 2 * s - 1;
  }
  NEF_ASSERT(false);  // successive quaternions of a chain are different rotations
  return 0;
}

}  // namespace

std::optional<PathProof> make_turning_proof(const Scene& scene, const TurningProof& found, const Monitor& monitor) {
  const RotationClaim meant = rotation_claim_of(scene);
  const TurningAxis axis(scene.rotation->axis);
  PathProof proof;
  proof.claim = no_path_claim(MotionChecker::of_scene(scene, monitor), meant);
  proof.layers.emplace().charts.resize(meant.chain.size() - 1);
  const auto enclosures = enclosures_of(sides_of(scene, found, monitor), reach_of(scene.robot), monitor);
  if (!enclosures) return std::nullopt;
  const Orientations orientations = Orientations::along(meant.chain);
  const BlockingPairs pairs(proof.claim, orientations, {0, 0, 0}, monitor);
  SimplexCutter cutter(proof, pairs, monitor);
  const bool is_closed = !meant.places && are_proportional(meant.chain.front(), meant.chain.back());
  OrientationBox<Rational> box;
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    const Turn& end = found.breakpoints[i + 1];
    const bool ends_chart = end == meant.turns[box.chart + 1];
    box.high[0] = ends_chart
                      ? Rational(1)
                      : chain_parameter_of(axis.quaternion(end), meant.chain[box.chart], meant.chain[box.chart + 1]);
    PathProof::Layer& layer = proof.layers->charts[box.chart].emplace_back();
    layer.until = box.high[0];
    const Polyhedron& here = (*enclosures)[i];
    if (!cutter.cut(triangles_of(here, monitor), box, layer.barrier)) return std::nullopt;
    box.low[0] = box.high[0];
    if (i + 1 < found.cells.size() || is_closed) {
      const Polyhedron& next = (*enclosures)[(i + 1) % found.cells.size()];
      for (const auto& [more, less] : {std::pair(&here, &next), std::pair(&next, &here)}) {
        const Polyhedron only = subtract(*more, *less, monitor);
        if (!cutter.cut(tetrahedra_of(only, monitor), box, layer.closing)) return std::nullopt;
      }
    }
    if (!ends_chart) continue;
    ++box.chart;
    box.low[0] = -1;
  }
  if (complaint_about(proof, monitor)) return std::nullopt;
  return proof;
}

}  // namespace nef::planner
