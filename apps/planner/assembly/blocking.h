// SPDX-License-Identifier: Apache-2.0
//
// Which part is in the way of which, when it moves straight: the directional blocking graphs of an assembly
// [Wilson, Latombe 1994], from the sums of pairs.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "apps/planner/free_space/hulls_apart.h"
#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// Part a overlaps part b when moved by the vectors of an open set, the union of the interiors of convex bodies: sums
/// of convex pieces of b and of -a. All answers are exact. Bodies are made when a question needs them, so an object
/// belongs to one thread.
class Blocking {
 public:
  /// The parts must be bounded solids. O(parts) boxes and decompositions into convex pieces.
  Blocking(const std::vector<Polyhedron>& parts, const Monitor& monitor);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  /// Two parts whose interiors meet where they are; nothing if there are none.
  std::optional<std::pair<std::size_t, std::size_t>> overlapping();
  /// True if a overlaps b somewhere on its way along the ray of direction d.
  bool blocks(std::size_t a, std::size_t b, const Rational3& d);
  /// True if a overlaps b as soon as it moves in direction d, however little.
  bool blocks_at_once(std::size_t a, std::size_t b, const Rational3& d);
  /// What keeps a from beginning to move: open cones of directions, each the set where all of its normals n have
  /// n * d < 0. Their union is what is forbidden.
  std::vector<std::vector<Rational3>> blocked_cones(std::size_t a);
  /// Directions such that whatever set of parts may begin to move in some direction may begin to move in one of these:
  /// the vertices of the arrangement on the sphere of the planes in which parts touch, and of the coordinate planes.
  /// (In a direction next to a vertex no fewer parts block than at it, since what blocks is open.) In order of their
  /// size. Nothing if there are more than a few ten thousand.
  std::optional<std::vector<Rational3>> directions();

 private:
  struct Body {
    std::vector<HalfSpace> faces;
    [[nodiscard]] bool meets_ray(const Rational3& d) const;
    [[nodiscard]] bool meets_start(const Rational3& d) const;
    [[nodiscard]] bool holds_origin(bool inside) const;
  };
  struct Pair {
    Body box;  // around all bodies
    std::optional<std::vector<Body>> bodies;
  };

  // The pair a < b, and its bodies.
  Pair& pair(std::size_t a, std::size_t b) { return pairs_[a * size() + b]; }
  const std::vector<Body>& bodies(std::size_t a, std::size_t b);
  [[nodiscard]] Body box_body(std::size_t a, std::size_t b) const;

  Monitor monitor_;
  std::vector<std::array<Rational3, 2>> boxes_;
  std::vector<std::vector<std::vector<Rational3>>> pieces_;  // of each part: the vertices of its convex pieces
  std::vector<Pair> pairs_;
};

}  // namespace nef::planner
