// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/turning/reachable_part.h"
#include "apps/planner/turning/turning_proof.h"
#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/geometry/rational_vectors.h"
#include "nef/parts/split.h"

namespace nef::planner {
namespace {

using Points = std::vector<Rational3>;

// Thrown where the proof does not hold.
struct Complaint {
  std::string text;
};

void require(bool holds, const std::string& text) {
  if (!holds) throw Complaint{text};
}

// The convex pieces of a set by their vertices, and that they are no more than the set; of a solid the solid ones. (The
// inside of a solid without the walls between the pieces is dense in it, so it meets the same open sets.)
std::vector<Points> pieces_of(const Polyhedron& set) {
  std::vector<Points> pieces;
  std::vector<Polyhedron> hulls;
  const bool solid = set.is_regular();
  for (const minkowski::ConvexCell& cell : minkowski::decompose(set)) {
    if (solid && cell.dimension < 3) continue;
    pieces.push_back(cell.mesh.vertices);
    hulls.push_back(convex_hull(pieces.back()));
  }
  require(subtract(unite_all(hulls), set).is_empty(), "a set was cut into pieces that are not in it");
  return pieces;
}

class ProofCheck {
 public:
  ProofCheck(const TurningProof& proof, const Scene& scene, const TurningQuestion& question)
      : proof_(proof), scene_(scene), q_(question) {
    require(scene.robot.is_bounded() && scene.robot.is_regular(), "the robot is no bounded solid");
    robot_ = pieces_of(scene.robot);
    for (const Polyhedron& obstacle : scene.obstacles) {
      for (Points& piece : pieces_of(closure(reachable_part(obstacle, scene)))) {
        obstacles_.push_back(std::move(piece));
      }
    }
    for (const Points& piece : robot_) meshes_.push_back(convex_hull_mesh(piece));
  }

  void run() {
    check_breakpoints();
    for (std::size_t i = 0; i < proof_.cells.size(); ++i) check_inner(i);
    join();
    check_sides();
  }

 private:
  [[nodiscard]] std::string cell_name(std::size_t i) const {
    return "cell " + std::to_string(i) + " (" + std::to_string(q_.axis.degrees_of(proof_.breakpoints[i])) + " to " +
           std::to_string(q_.axis.degrees_of(proof_.breakpoints[i + 1])) + " degrees)";
  }

  void check_breakpoints() const {
    const std::vector<Turn>& at = proof_.breakpoints;
    require(at.size() == proof_.cells.size() + 1 && at.size() >= 2, "there must be a cell between two breakpoints");
    require(at.front() == q_.low && at.back() == q_.high, "the breakpoints do not cover the range of the scene");
    for (const Turn& end : {q_.start.turn, q_.goal.turn}) {
      require(std::find(at.begin(), at.end(), end) != at.end(), "start and goal must be at breakpoints");
    }
    const Rational3& n = q_.axis.direction();
    const Rational3 across = cross(n, n[0] == 0 && n[1] == 0 ? Rational3{1, 0, 0} : Rational3{0, 0, 1});
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      require(at[i] < at[i + 1] && at[i + 1] - at[i] < 2, "breakpoint " + std::to_string(i + 1) + " is out of order");
      const Rational3 from = q_.axis.rotation(at[i])(across);
      const Rational3 to = q_.axis.rotation(at[i + 1])(across);
      require(dot(n, cross(from, to)) > 0, cell_name(i) + " is wider than a half turn");
    }
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
      const Rational room = offset - dot(normal, n) * dot(point, n) / q_.axis.square();
      const Rational3 lever = across(normal);
      if (room < 0 || room * room < dot(lever, lever) * dot(arm, arm)) return false;
    }
    return true;
  }

  void check_inner(std::size_t i) const {
    const AffineMap at_a = q_.axis.rotation(proof_.breakpoints[i]);
    const AffineMap at_b = q_.axis.rotation(proof_.breakpoints[i + 1]);
    for (const Points& inner : proof_.cells[i].inner) {
      const bool held = std::any_of(meshes_.begin(), meshes_.end(), [&](const Mesh& piece) {
        return std::all_of(inner.begin(), inner.end(),
                           [&](const Rational3& v) { return stays_inside(v, piece, at_a, at_b); });
      });
      require(held, "the robot does not hold its inner robot at every angle of " + cell_name(i));
    }
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
        const Polyhedron hull = convex_hull(differences);
        forbidden.push_back(scene_.contact == ContactRule::kAllow ? interior(hull) : hull);
      }
    }
    const Polyhedron united = unite_all(forbidden);
    return split(scene_.box ? subtract(make_box((*scene_.box)[0], (*scene_.box)[1]), united) : complement(united));
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
  void join() {
    for (std::size_t i = 0; i < proof_.breakpoints.size(); ++i) {
      const bool closes = i + 1 == proof_.breakpoints.size() && q_.is_ring();
      layers_.push_back(closes ? layers_.front() : layer_of(robot_at(proof_.breakpoints[i])));
      if (i < proof_.cells.size()) layers_.push_back(layer_of(proof_.cells[i].inner));
    }
    joined_ = UnionFind(count_);
    for (std::size_t i = 0; i + 1 < layers_.size(); ++i) {
      for (std::size_t a = 0; a < layers_[i].components.size(); ++a) {
        for (std::size_t b = 0; b < layers_[i + 1].components.size(); ++b) {
          if (intersect(layers_[i].components[a], layers_[i + 1].components[b]).is_empty()) continue;
          joined_.unite(static_cast<std::uint32_t>(layers_[i].first + a),
                        static_cast<std::uint32_t>(layers_[i + 1].first + b));
        }
      }
    }
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

  [[nodiscard]] std::uint32_t end_of(const Pose& pose, const std::string& name) const {
    const auto at = std::find(proof_.breakpoints.begin(), proof_.breakpoints.end(), pose.turn);
    const auto component =
        component_at(layers_[2 * static_cast<std::size_t>(at - proof_.breakpoints.begin())], pose.position);
    require(component.has_value(), "the " + name + " is not free");
    return *component;
  }

  void check_sides() {
    const std::uint32_t start = joined_.find(end_of(q_.start, "start"));
    require(joined_.find(end_of(q_.goal, "goal")) != start, "start and goal are not apart");
    for (std::size_t i = 0; i < proof_.cells.size(); ++i) {
      const Layer& layer = layers_[2 * i + 1];
      std::vector<bool> named(layer.components.size(), false);
      for (const Rational3& point : proof_.cells[i].start_side) {
        const auto component = component_at(layer, point);
        require(component && joined_.find(*component) == start,
                cell_name(i) + " names a position that is not joined to the start");
        named[*component - layer.first] = true;
      }
      for (std::size_t a = 0; a < named.size(); ++a) {
        const bool of_start = joined_.find(static_cast<std::uint32_t>(layer.first + a)) == start;
        require(named[a] == of_start, cell_name(i) + " leaves out a component that is joined to the start");
      }
    }
  }

  const TurningProof& proof_;
  const Scene& scene_;
  const TurningQuestion& q_;
  std::vector<Points> robot_;      // convex pieces ...
  std::vector<Mesh> meshes_;       // ... and their faces
  std::vector<Points> obstacles_;  // convex pieces of all obstacles
  std::vector<Layer> layers_;
  std::size_t count_ = 0;
  UnionFind joined_{0};
};

}  // namespace

std::optional<std::string> complaint_about(const TurningProof& proof, const Scene& scene,
                                           const TurningQuestion& question) {
  try {
    ProofCheck(proof, scene, question).run();
    return std::nullopt;
  } catch (const Complaint& complaint) {
    return complaint.text;
  }
}

}  // namespace nef::planner
