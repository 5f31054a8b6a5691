// SPDX-License-Identifier: Apache-2.0
//
// Space as a binary partition with a third child for the plane itself: every point of space is in
// exactly one leaf, a convex relatively open piece of one cell of a complex.
//
// The tree answers all questions of motion: where is a point (O(depth) signs), which cells does a
// segment run through (segment_walk.h), and which convex pieces make up a volume or facet (see roadmap.h). Splits use
// planes of the complex, and axis-parallel ones through isolated points; a vertex, edge or facet
// that two leaves share is never lost, since what lies in a splitting plane has a tree of its own.
//
// Why a leaf belongs to one cell: a splitting stops only if no part of a cell of smaller dimension
// lies inside the (connected) region, and cells can change only there.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "apps/planner/partition/cells.h"
#include "apps/planner/partition/convex_piece.h"
#include "apps/planner/partition/exact_point.h"
#include "nef/base/monitor.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {

using LeafId = std::uint32_t;
inline constexpr LeafId kNoLeaf = 0xffffffffU;

/// A direction in which a point is moved by an infinitely small amount.
using Nudge = Integer3;

/// The corners of a box that holds the finite vertices of a complex with room to spare. O(n).
std::array<Rational3, 2> padded_box(const Complex& complex);

/// The ternary space partition of a complex without infimaximal box.
class SpaceTree {
 public:
  struct Leaf {
    int dimension = 3;
    /// The cell; kNoCell for a lower-dimensional leaf inside a volume (or beyond everything).
    CellId cell = kNoCell;
  };
  struct Node {
    PlaneId plane;
    std::array<std::uint32_t, 3> child{};  ///< below, on, above; see is_leaf
  };

  /// What a tree is made of; see the accessors.
  struct Parts {
    std::vector<Node> nodes;
    std::vector<Leaf> leaves;
    std::uint32_t root = 0;
    PlaneTable planes;
    std::array<PlaneId, 6> box;
  };
  explicit SpaceTree(Parts parts) : t_(std::move(parts)) {}

  /// Builds the tree (a binary space partition [Fuchs, Kedem, Naylor 1980], with a third child for what lies in
  /// the plane). The complex must outlive it. Expected O(n log n) to O(n^2) pieces for n
  /// facets. Throws UnsupportedError for a complex with an infimaximal box.
  SpaceTree(const Complex& complex, const CellNumbering& cells, const Monitor& monitor);

  [[nodiscard]] const PlaneTable& planes() const { return t_.planes; }
  [[nodiscard]] std::span<const Leaf> leaves() const { return t_.leaves; }
  [[nodiscard]] std::span<const Node> nodes() const { return t_.nodes; }
  [[nodiscard]] std::uint32_t root() const { return t_.root; }
  static bool is_leaf(std::uint32_t child) { return (child & kLeafBit) != 0; }
  static LeafId leaf_of(std::uint32_t child) { return child & ~kLeafBit; }
  static std::uint32_t child_of(LeafId leaf) { return leaf | kLeafBit; }

  /// Planes of a box that holds the complex with room to spare: low x, high x, low y, ...
  [[nodiscard]] const std::array<PlaneId, 6>& box() const { return t_.box; }

  /// The two corners of that box.
  [[nodiscard]] std::array<Rational3, 2> bounds() const;
  /// The nearest point of a box a little smaller than that one, which holds the complex too. So what is beyond it is
  /// part of the outer volume, and so is the segment from there to the nearest point.
  [[nodiscard]] Rational3 nearest_inside(const Rational3& point) const;

  /// Sets the cells of all 3-dimensional leaves; roadmap.h finds them out.
  void set_volume(LeafId leaf, CellId volume) { t_.leaves[leaf].cell = volume; }

  /// The cell that holds the point.
  [[nodiscard]] CellId locate(const ExactPoint& point) const;

  /// The leaf that holds point + e u0 + e^2 u1 + ... for infinitely small e.
  [[nodiscard]] LeafId leaf_at(const ExactPoint& point, std::span<const Nudge> nudges) const;
  /// The leaf that holds the point, but where that is one inside a volume of lower dimension, a
  /// 3-dimensional leaf beside it.
  [[nodiscard]] LeafId leaf_at(const ExactPoint& point) const;

 private:
  static constexpr std::uint32_t kLeafBit = 0x80000000U;

  Parts t_;
};

/// x, y and z.
inline const std::array<Nudge, 3>& axes() {
  static const std::array<Nudge, 3> value{Nudge{1, 0, 0}, Nudge{0, 1, 0}, Nudge{0, 0, 1}};
  return value;
}

/// Some vector across n, which must not be zero.
inline Nudge across(const Nudge& n) {
  for (const Nudge& axis : axes()) {
    Nudge u = cross(n, axis);
    if (!is_zero(u)) return u;
  }
  return n;
}

}  // namespace nef::planner
