// SPDX-License-Identifier: Apache-2.0
//
// Let K be a bounded component of the free positions and r less than its distance from the others. The boundary of the
// sum of K and the cube from -r to r has distance r from K in every point, measured by the largest coordinate, so
// nothing of it is free. Its triangles are cut at midpoints of longest edges, on both sides of an edge at once, until
// each of them lies in the positions at which one pair of pieces overlaps, or beyond a side of the box. These sets are
// open and cover it, so that comes to an end.
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/intersection/common_point.h"
#include "apps/planner/proofs/check/check_parts.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/distance/distance.h"
#include "nef/export/to_mesh.h"
#include "nef/geometry/vectors.h"
#include "nef/parts/split.h"

namespace nef::planner {
namespace {

using Corners = std::array<Rational3, 3>;
using PieceBox = std::array<Rational3, 2>;
using Pair = std::array<std::uint32_t, 2>;

PieceBox piece_box(std::span<const Rational3> points) {
  PieceBox box{points.front(), points.front()};
  for (const Rational3& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] = std::min(box[0][k], p[k]);
      box[1][k] = std::max(box[1][k], p[k]);
    }
  }
  return box;
}

// The positions at which pairs of pieces overlap, as far as they are asked for.
class Overlaps {
 public:
  explicit Overlaps(const PathProof::Claim& claim) : claim_(claim) {
    for (std::uint32_t i = 0; i < claim.robot.size(); ++i) {
      for (std::uint32_t j = 0; j < claim.obstacles.size(); ++j) {
        const bool solid = !is_flat(claim.robot[i]) && !is_flat(claim.obstacles[j]);
        if (!solid && claim.contact == ContactRule::kAllow) continue;
        const PieceBox a = piece_box(claim.robot[i]);
        const PieceBox b = piece_box(claim.obstacles[j]);
        pairs_.push_back({{i, j}, {minus(b[0], a[1]), minus(b[1], a[0])}, {}});
      }
    }
  }

  // The first pair that overlaps at all three corners.
  std::optional<Pair> pair_at(const Corners& corners) {
    for (Entry& entry : pairs_) {
      const bool may = std::all_of(corners.begin(), corners.end(), [&](const Rational3& p) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (p[k] <= entry.box[0][k] || p[k] >= entry.box[1][k]) return false;
        }
        return true;
      });
      if (!may) continue;
      const std::vector<HalfSpace>& sides = sides_of(entry);
      const bool inside = !sides.empty() && std::all_of(corners.begin(), corners.end(), [&](const Rational3& p) {
        return std::all_of(sides.begin(), sides.end(),
                           [&](const HalfSpace& side) { return dot(side.normal, p) < side.offset; });
      });
      if (inside) return entry.pair;
    }
    return std::nullopt;
  }

 private:
  struct HalfSpace {
    Rational3 normal;
    Rational offset;
  };
  struct Entry {
    Pair pair;
    PieceBox box;
    std::vector<HalfSpace> sides;
  };

  const std::vector<HalfSpace>& sides_of(Entry& entry) {
    if (!entry.sides.empty()) return entry.sides;
    std::vector<Rational3> differences;
    for (const Rational3& b : claim_.obstacles[entry.pair[1]]) {
      for (const Rational3& a : claim_.robot[entry.pair[0]]) differences.push_back(minus(b, a));
    }
    const Hull hull = hull_of(differences);
    for (std::size_t f = 0; hull.dimension == 3 && f < hull.mesh.face_count(); ++f) {
      const auto ring = hull.mesh.face(f);
      const Rational3& p = hull.mesh.vertices[ring[0]];
      const Rational3 normal = cross(minus(hull.mesh.vertices[ring[1]], p), minus(hull.mesh.vertices[ring[2]], p));
      entry.sides.push_back({normal, dot(normal, p)});
    }
    return entry.sides;
  }

  const PathProof::Claim& claim_;
  std::vector<Entry> pairs_;
};

class BarrierMaker {
 public:
  BarrierMaker(PathProof& proof, const Monitor& monitor)
      : claim_(proof.claim), barrier_(proof.barrier.emplace()), overlaps_(claim_), monitor_(monitor) {}

  // False if it has no end in sight.
  bool run(const Mesh& surface) {
    barrier_.points = surface.vertices;
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      const auto ring = surface.face(f);
      add({{ring[0], ring[1], ring[2]}, {}});
    }
    while (!open_.empty()) {
      constexpr std::size_t kMost = 100000;
      if (made_.size() > kMost) return false;
      monitor_.check_interruption();
      const std::size_t t = open_.front();
      open_.pop_front();
      if (!gone_[t] && !close(made_[t])) split_longest_edge(t);
    }
    for (std::size_t t = 0; t < made_.size(); ++t) {
      if (!gone_[t]) barrier_.triangles.push_back(std::move(made_[t]));
    }
    return true;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  void add(PathProof::Triangle triangle) {
    for (std::size_t k = 0; k < 3; ++k) around_[edge(triangle, k)].push_back(made_.size());
    open_.push_back(made_.size());
    made_.push_back(std::move(triangle));
    gone_.push_back(false);
  }

  static Edge edge(const PathProof::Triangle& triangle, std::size_t k) {
    return std::minmax(triangle.corners[k], triangle.corners[(k + 1) % 3]);
  }

  // Whether a triangle can stay: it is beyond the box, or a pair of pieces overlaps on all of it.
  bool close(PathProof::Triangle& triangle) {
    const Corners corners{barrier_.points[triangle.corners[0]], barrier_.points[triangle.corners[1]],
                          barrier_.points[triangle.corners[2]]};
    for (std::size_t k = 0; claim_.box && k < 3; ++k) {
      const auto [low, high] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
      if (high < (*claim_.box)[0][k] || low > (*claim_.box)[1][k]) return true;
    }
    const std::optional<Pair> pair = overlaps_.pair_at(corners);
    if (!pair) return false;
    PathProof::Triangle::Hit hit;
    hit.robot = (*pair)[0];
    hit.obstacle = (*pair)[1];
    for (std::size_t k = 0; k < 3; ++k) hit.common[k] = common_at(*pair, triangle.corners[k]);
    triangle.hit = std::move(hit);
    return true;
  }

  const CommonPoint& common_at(const Pair& pair, std::uint32_t point) {
    const auto [found, is_new] = common_.try_emplace({pair, point});
    if (!is_new) return found->second;
    std::vector<Rational3> placed;
    for (const Rational3& v : claim_.robot[pair[0]]) {
      const Rational3& at = barrier_.points[point];
      placed.push_back({v[0] + at[0], v[1] + at[1], v[2] + at[2]});
    }
    HullWitness witness = witness_of_hulls(placed, claim_.obstacles[pair[1]], claim_.contact == ContactRule::kAllow);
    NEF_ASSERT(witness.common);  // the position is inside all sides of the differences
    found->second = *std::move(witness.common);
    return found->second;
  }

  void split_longest_edge(std::size_t t) {
    Edge longest = edge(made_[t], 0);
    Rational length = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge candidate = edge(made_[t], k);
      const Rational3 along = minus(barrier_.points[candidate.first], barrier_.points[candidate.second]);
      if (const Rational square = dot(along, along); square > length) {
        length = square;
        longest = candidate;
      }
    }
    const auto middle = static_cast<std::uint32_t>(barrier_.points.size());
    const Rational3 a = barrier_.points[longest.first];
    const Rational3 b = barrier_.points[longest.second];
    barrier_.points.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    for (const std::size_t old : std::exchange(around_[longest], {})) {
      if (gone_[old]) continue;
      gone_[old] = true;
      const std::array<std::uint32_t, 3> corners = made_[old].corners;
      for (const std::uint32_t end : {longest.first, longest.second}) {
        PathProof::Triangle half{corners, {}};
        std::replace(half.corners.begin(), half.corners.end(), end, middle);
        add(half);
      }
    }
  }

  const PathProof::Claim& claim_;
  PathProof::Barrier& barrier_;
  Overlaps overlaps_;
  Monitor monitor_;
  std::vector<PathProof::Triangle> made_;
  std::vector<bool> gone_;
  std::map<Edge, std::vector<std::size_t>> around_;  // triangles of an edge, with some that are gone
  std::deque<std::size_t> open_;
  std::map<std::pair<Pair, std::uint32_t>, CommonPoint> common_;
};

// The component that holds one of two points and is bounded, and all others.
std::optional<std::array<Polyhedron, 2>> component_and_rest(const Polyhedron& free, const Rational3& start,
                                                            const Rational3& goal, const Monitor& monitor) {
  const std::vector<Polyhedron> components = split(free, monitor);
  for (const Rational3* inside : {&start, &goal}) {
    const Rational3& beyond = inside == &start ? goal : start;
    for (const Polyhedron& component : components) {
      if (!component.is_bounded() || !contains(component, *inside) || contains(component, beyond)) continue;
      return std::array{component, subtract(free, component, monitor)};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<PathProof> make_barrier_proof(const Scene& scene, const Polyhedron& free, const Rational3& start,
                                            const Rational3& goal, const Monitor& monitor) {
  const auto parts = component_and_rest(free, start, goal, monitor);
  if (!parts) return std::nullopt;
  const std::optional<Distance> gap = distance((*parts)[0], (*parts)[1], monitor);
  if (!gap || gap->squared == 0) return std::nullopt;
  // A power of two, at most a quarter of the distance, which is less than its largest coordinate.
  const Rational r = exact_rational(std::exp2(std::floor(std::log2(std::sqrt(nearest_double(gap->squared)) / 4))));
  minkowski::MinkowskiOptions options;
  options.monitor = monitor;
  const Polyhedron wider =
      minkowski::minkowski_sum(closure((*parts)[0], monitor), make_box({-r, -r, -r}, {r, r, r}, monitor), options);
  PathProof proof;
  proof.claim.status = PathProof::Claim::Status::kInfeasible;
  proof.claim.contact = scene.contact;
  proof.claim.box = scene.box;
  const MotionChecker pieces = MotionChecker::of_scene(scene, monitor);
  for (const RigidBody::Piece& piece : pieces.robot().pieces()) proof.claim.robot.push_back(piece.mesh.vertices);
  for (const RigidBody::Piece& piece : pieces.obstacles().pieces()) {
    proof.claim.obstacles.push_back(piece.mesh.vertices);
  }
  proof.claim.path = {{start, {1, 0, 0, 0}}, {goal, {1, 0, 0, 0}}};
  if (!BarrierMaker(proof, monitor).run(to_mesh(wider, {}, monitor).mesh)) return std::nullopt;
  return proof;
}

}  // namespace nef::planner
