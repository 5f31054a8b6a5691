// SPDX-License-Identifier: Apache-2.0
//
// Which part is in the way of which, when it moves straight: the directional blocking graphs of an assembly
// [Wilson, Latombe 1994].
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "apps/planner/assembly/contact_cones.h"
#include "apps/planner/assembly/entry_faces.h"
#include "apps/planner/assembly/separation.h"
#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// Answers about pairs of parts, all exact: from the places where they touch for the beginning of a motion, and from
/// the projections of their faces for motions to infinity. What a question needs is made when it is asked, and kept, so
/// an object belongs to one thread.
class Blocking {
 public:
  /// The parts must be bounded solids. O(n).
  Blocking(const std::vector<Polyhedron>& parts, const Monitor& monitor);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  /// The box around a part.
  [[nodiscard]] const std::array<Rational3, 2>& box(std::size_t part) const { return boxes_[part]; }
  /// The box around some parts, at least one.
  [[nodiscard]] std::array<Rational3, 2> box_of(const PartSet& parts) const;
  /// True if the box of a, moved from one vector to another, overlaps that of b on the way.
  [[nodiscard]] bool boxes_meet_on(std::size_t a, std::size_t b, const Rational3& from, const Rational3& to) const;
  [[nodiscard]] const Polyhedron& interior(std::size_t part) const { return interiors_[part]; }
  /// Two parts whose interiors meet where they are; nothing if there are none.
  std::optional<std::pair<std::size_t, std::size_t>> overlapping();
  /// How two parts touch, a < b, and what blocks a; nothing if they overlap.
  const std::optional<ContactCones>& contact(std::size_t a, std::size_t b);
  /// True if a overlaps b somewhere on its way along the ray of direction d. No parts may overlap where they are.
  bool blocks(std::size_t a, std::size_t b, const Rational3& d);
  /// True if a overlaps b as soon as it moves in direction d, however little.
  bool blocks_at_once(std::size_t a, std::size_t b, const Rational3& d);
  /// The directions in which b keeps a from beginning to move.
  std::vector<OpenCone> blocked_cones(std::size_t a, std::size_t b);
  /// The directions in which some parts keep others from beginning to move.
  std::set<OpenCone> blocked_cones(const PartSet& moving, const PartSet& stay);
  /// True if there are such directions. (Then each of the two blocks the other one.)
  bool blocks_some_beginning(std::size_t a, std::size_t b);
  /// True if no set of some parts may begin to move in direction d: each of them is led to from each other one along
  /// parts that block each other at once.
  bool are_tied_at_once(const PartSet& parts, const Rational3& d);
  /// Directions such that whatever set of parts may begin to move in some direction may begin to move in one of these:
  /// the vertices of the arrangement on the sphere of the planes in which parts touch, and of the coordinate planes.
  /// (In a direction next to a vertex no fewer parts block than at it, since what blocks is open.) In order of their
  /// size. Nothing if there are more than a few thousand.
  std::optional<std::vector<Rational3>> directions();

 private:
  using Pair = std::pair<std::size_t, std::size_t>;
  /// The cones in which the first of two parts that touch is blocked, by the numbers of their normals.
  struct Tie {
    Pair parts;
    std::vector<std::vector<std::size_t>> cones;
  };
  [[nodiscard]] bool boxes_meet(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool box_meets(std::size_t a, std::size_t b, const Rational3& from, const Rational3& d,
                               std::optional<Rational> most) const;
  const std::vector<Tie>& ties();
  const EntryFaces& entry_faces(std::size_t part, const Rational3& d);

  Monitor monitor_;
  std::vector<Polyhedron> interiors_;
  std::vector<std::array<Rational3, 2>> boxes_;
  std::vector<std::optional<std::optional<ContactCones>>> contacts_;  // of each pair a < b
  std::vector<std::optional<Mesh>> meshes_;
  Rational3 direction_;  // of the faces below
  std::map<std::size_t, EntryFaces> faces_;
  std::map<Rational3, std::map<Pair, bool>> blocks_;  // of each direction, what was asked
  std::optional<std::vector<Tie>> ties_;
  std::vector<Rational3> normals_;  // of the ties, each once
};

}  // namespace nef::planner
