// SPDX-License-Identifier: Apache-2.0
//
// 1. Robot and obstacles are cut into convex pieces, whose union must lie in the set.
// 2. The breakpoints must be ascending, cover the range, and include start and goal.
// 3. All vertices of an inner piece must stay in one piece of the robot over the cell. A face of that piece turns
//    furthest over the point where its normal points along the point's arm; this and both ends are tested, by squares
//    instead of roots.
// 4. For each breakpoint and each cell, the free positions are the box without the hulls of differences of pieces,
//    split into components. Components of neighbours that intersect are joined.
// 5. The goal's component must not be joined to the start's, and the positions that the proof names must be exactly
//    those on the side of the start.
#include <algorithm>
#include <iterator>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_proof.h"
#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/parts/split.h"

namespace nef::planner {
namespace {

using Points = std::vector<Rational3>;

// What does not hold; nothing if all does.
using Complaint = std::optional<std::string>;

// The convex pieces of a set by their vertices, if they are no more than the set; of a solid the solid ones. (The
// inside of a solid without the walls between the pieces is dense in it, so it meets the same open sets.)
std::optional<std::vector<Points>> pieces_of(const Polyhedron& set, const Monitor& monitor) {
  std::vector<Points> pieces;
  std::vector<Polyhedron> hulls;
  const bool solid = set.is_regular();
  for (const minkowski::ConvexCell& cell : minkowski::decompose(set, monitor)) {
    if (solid && cell.dimension < 3) continue;
    pieces.push_back(cell.mesh.vertices);
    hulls.push_back(convex_hull(pieces.back(), monitor));
  }
  if (!subtract(unite_all(hulls, monitor), set, monitor).is_empty()) return std::nullopt;
  return pieces;
}

class ProofCheck {
 public:
  ProofCheck(const TurningProof& proof, const Scene& scene, const TurningQuestion& question, const Monitor& monitor)
      : proof_(proof), scene_(scene), q_(question), monitor_(monitor) {}

  Complaint run() {
    for (const auto check : {&ProofCheck::cut_up, &ProofCheck::check_breakpoints, &ProofCheck::check_inner_robots,
                             &ProofCheck::join, &ProofCheck::check_sides}) {
      if (Complaint complaint = (this->*check)()) return complaint;
    }
    return std::nullopt;
  }

 private:
  Complaint cut_up() {
    static const std::string kWrongPieces = "a set was cut into pieces that are not in it";
    if (!scene_.robot.is_bounded() || !scene_.robot.is_regular()) return "the robot is not a bounded solid";
    std::optional<std::vector<Points>> robot = pieces_of(scene_.robot, monitor_);
    if (!robot) return kWrongPieces;
    robot_ = *std::move(robot);
    for (const Points& piece : robot_) meshes_.push_back(convex_hull_mesh(piece, monitor_));
    for (const Polyhedron& obstacle : scene_.obstacles) {
      std::optional<std::vector<Points>> pieces =
          pieces_of(closure(reachable_part(obstacle, scene_, monitor_), monitor_), monitor_);
      if (!pieces) return kWrongPieces;
      std::move(pieces->begin(), pieces->end(), std::back_inserter(obstacles_));
    }
    return std::nullopt;
  }

  [[nodiscard]] std::string cell_name(std::size_t i) const {
    return "cell " + std::to_string(i) + " (" + std::to_string(q_.axis.degrees_of(proof_.breakpoints[i])) + " to " +
           std::to_string(q_.axis.degrees_of(proof_.breakpoints[i + 1])) + " degrees)";
  }

  Complaint check_breakpoints() {
    const std::vector<Turn>& at = proof_.breakpoints;
    if (at.size() != proof_.cells.size() + 1 || at.size() < 2) return "there must be a cell between two breakpoints";
    if (at.front() != q_.low || at.back() != q_.high) return "the breakpoints do not cover the range of the scene";
    for (const Turn& end : {q_.start.turn, q_.goal.turn}) {
      if (std::find(at.begin(), at.end(), end) == at.end()) return "start and goal must be at breakpoints";
    }
    const Rational3& n = q_.axis.direction();
    const Rational3 across = cross(n, n[0] == 0 && n[1] == 0 ? Rational3{1, 0, 0} : Rational3{0, 0, 1});
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      if (at[i] >= at[i + 1] || at[i + 1] - at[i] >= 2) {
        return "breakpoint " + std::to_string(i + 1) + " is out of order";
      }
      const Rational3 from = q_.axis.rotation(at[i])(across);
      const Rational3 to = q_.axis.rotation(at[i + 1])(across);
      if (dot(n, cross(from, to)) <= 0) return cell_name(i) + " is wider than a half turn";
    }
    return std::nullopt;
  }

  // True if a point that stands still is in the robot's piece at every angle from a to b.
  [[nodiscard]] bool stays_inside(const Rational3& point, const Mesh& piece, const AffineMap& at_a,
                                  const AffineMap& at_b) const {
    const Rational3& n = q_.axis.direction();
    const auto across = [&](const Rational3& v) {
      const Rational along = dot(v, n) / q_.axis.square();
      return Rational3{v[0] - along * n[0], v[1] - along * n[1], v[2] - along * n[2]};
    };
    const Rational3 arm = across(point);
    for (std::size_t f = 0; f < piece.face_count(); ++f) {
      const auto ring = piece.face(f);
      const Rational3& p = piece.vertices[ring[0]];
      const Rational3 normal = cross(minus(piece.vertices[ring[1]], p), minus(piece.vertices[ring[2]], p));
      const Rational offset = dot(normal, p);
      const Rational3 from = at_a(normal);
      const Rational3 to = at_b(normal);
      if (dot(from, point) > offset || dot(to, point) > offset) return false;
      // Between the ends the face turns furthest over the point where its normal points along the arm.
      const bool passes = dot(n, cross(across(from), arm)) > 0 && dot(n, cross(arm, across(to))) > 0;
      if (!passes) continue;
      const Rational slack = offset - dot(normal, n) * dot(point, n) / q_.axis.square();
      const Rational3 lever = across(normal);
      if (slack < 0 || slack * slack < dot(lever, lever) * dot(arm, arm)) return false;
    }
    return true;
  }

  Complaint check_inner_robots() {
    for (std::size_t i = 0; i < proof_.cells.size(); ++i) {
      const AffineMap at_a = q_.axis.rotation(proof_.breakpoints[i]);
      const AffineMap at_b = q_.axis.rotation(proof_.breakpoints[i + 1]);
      for (const Points& inner : proof_.cells[i].inner) {
        const bool held = std::any_of(meshes_.begin(), meshes_.end(), [&](const Mesh& piece) {
          return std::all_of(inner.begin(), inner.end(),
                             [&](const Rational3& v) { return stays_inside(v, piece, at_a, at_b); });
        });
        if (!held) return "the robot does not contain its inner robot at every angle of " + cell_name(i);
      }
    }
    return std::nullopt;
  }

  // The components of the positions at which no piece of the robot is in the way.
  [[nodiscard]] std::vector<Polyhedron> components_for(const std::vector<Points>& robot) const {
    std::vector<Polyhedron> forbidden;
    for (const Points& piece : robot) {
      for (const Points& obstacle : obstacles_) {
        Points differences;
        for (const Rational3& o : obstacle) {
          for (const Rational3& r : piece) differences.push_back(minus(o, r));
        }
        const Polyhedron hull = convex_hull(differences, monitor_);
        forbidden.push_back(scene_.contact == ContactRule::kAllow ? interior(hull, monitor_) : hull);
      }
    }
    const Polyhedron united = unite_all(forbidden, monitor_);
    return split(scene_.box ? subtract(make_box((*scene_.box)[0], (*scene_.box)[1], monitor_), united, monitor_)
                            : complement(united),
                 monitor_);
  }

  [[nodiscard]] std::vector<Points> robot_at(const Turn& turn) const {
    const AffineMap rotation = q_.axis.rotation(turn);
    std::vector<Points> result = robot_;
    for (Points& piece : result) {
      for (Rational3& v : piece) v = rotation(v);
    }
    return result;
  }

  // Breakpoint 0, cell 0, breakpoint 1, ...: the components of each, and their numbers among all. The last breakpoint
  // of a ring is the first one.
  Complaint join() {
    for (std::size_t i = 0; i < proof_.breakpoints.size(); ++i) {
      const bool closes = i + 1 == proof_.breakpoints.size() && q_.is_ring();
      layers_.push_back(closes ? layers_.front() : layer_of(robot_at(proof_.breakpoints[i])));
      if (i < proof_.cells.size()) layers_.push_back(layer_of(proof_.cells[i].inner));
    }
    joined_ = UnionFind(count_);
    for (std::size_t i = 0; i + 1 < layers_.size(); ++i) {
      for (std::size_t a = 0; a < layers_[i].components.size(); ++a) {
        for (std::size_t b = 0; b < layers_[i + 1].components.size(); ++b) {
          if (intersect(layers_[i].components[a], layers_[i + 1].components[b], monitor_).is_empty()) continue;
          joined_.unite(static_cast<std::uint32_t>(layers_[i].first + a),
                        static_cast<std::uint32_t>(layers_[i + 1].first + b));
        }
      }
    }
    return std::nullopt;
  }

  struct Layer {
    std::vector<Polyhedron> components;
    std::size_t first = 0;
  };
  [[nodiscard]] Layer layer_of(const std::vector<Points>& robot) {
    Layer layer{components_for(robot), count_};
    count_ += layer.components.size();
    return layer;
  }

  // The number of the component of a layer that holds a point.
  [[nodiscard]] std::optional<std::uint32_t> component_at(const Layer& layer, const Rational3& point) const {
    for (std::size_t a = 0; a < layer.components.size(); ++a) {
      if (contains(layer.components[a], point)) return static_cast<std::uint32_t>(layer.first + a);
    }
    return std::nullopt;
  }

  // The number of the component of a start or goal; nothing if that is not free.
  [[nodiscard]] std::optional<std::uint32_t> end_of(const Pose& pose) const {
    const auto at = std::find(proof_.breakpoints.begin(), proof_.breakpoints.end(), pose.turn);
    return component_at(layers_[2 * static_cast<std::size_t>(at - proof_.breakpoints.begin())], pose.position);
  }

  Complaint check_sides() {
    const std::optional<std::uint32_t> start = end_of(q_.start);
    const std::optional<std::uint32_t> goal = end_of(q_.goal);
    if (!start || !goal) return std::string("the ") + (start ? "goal" : "start") + " is not free";
    const std::uint32_t side = joined_.find(*start);
    if (joined_.find(*goal) == side) return "start and goal are not apart";
    for (std::size_t i = 0; i < proof_.cells.size(); ++i) {
      const Layer& layer = layers_[2 * i + 1];
      std::vector<bool> named(layer.components.size(), false);
      for (const Rational3& point : proof_.cells[i].start_side) {
        const auto component = component_at(layer, point);
        if (!component || joined_.find(*component) != side) {
          return cell_name(i) + " names a position that is not joined to the start";
        }
        named[*component - layer.first] = true;
      }
      for (std::size_t a = 0; a < named.size(); ++a) {
        const bool of_start = joined_.find(static_cast<std::uint32_t>(layer.first + a)) == side;
        if (named[a] != of_start) return cell_name(i) + " leaves out a component that is joined to the start";
      }
    }
    return std::nullopt;
  }

  const TurningProof& proof_;
  const Scene& scene_;
  const TurningQuestion& q_;
  Monitor monitor_;
  std::vector<Points> robot_;      // convex pieces ...
  std::vector<Mesh> meshes_;       // ... and their faces
  std::vector<Points> obstacles_;  // convex pieces of all obstacles
  std::vector<Layer> layers_;
  std::size_t count_ = 0;
  UnionFind joined_{0};
};

}  // namespace

std::optional<std::string> complaint_about(const TurningProof& proof, const Scene& scene,
                                           const TurningQuestion& question, const Monitor& monitor) {
  return ProofCheck(proof, scene, question, monitor).run();
}

}  // namespace nef::planner
