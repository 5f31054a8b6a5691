// SPDX-License-Identifier: Apache-2.0
//
// Queries of the tree; space_tree_builder.cpp makes it.
#include "apps/planner/partition/space_tree.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

int side_of_nudge(const PlaneTable& planes, PlaneId plane, const Nudge& nudge) {
  Integer sum;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_addmul(sum.get_mpz_t(), planes.coefficient(plane, i), nudge[i].get_mpz_t());
  }
  return sgn(sum);
}

// Unflipped normals have a positive first component, so this generic direction is above each.
int generic_side(int side) { return side == 0 ? 1 : side; }

// Children stand in the order: below, on, above.
std::size_t child_index(int side) { return side < 0 ? 0 : (side == 0 ? 1 : 2); }

}  // namespace

LeafId SpaceTree::leaf_at(const ExactPoint& point, std::span<const Nudge> nudges) const {
  std::uint32_t at = t_.root;
  while (!is_leaf(at)) {
    const Node& node = t_.nodes[at];
    int side = point.side(t_.planes, node.plane);
    for (std::size_t i = 0; i < nudges.size() && side == 0; ++i) side = side_of_nudge(t_.planes, node.plane, nudges[i]);
    at = node.child[child_index(side)];
  }
  return leaf_of(at);
}

LeafId SpaceTree::leaf_at(const ExactPoint& point) const {
  const LeafId leaf = leaf_at(point, std::span<const Nudge>{});
  if (t_.leaves[leaf].cell != kNoCell) return leaf;
  std::uint32_t at = t_.root;
  while (!is_leaf(at)) {
    const Node& node = t_.nodes[at];
    at = node.child[child_index(generic_side(point.side(t_.planes, node.plane)))];
  }
  return leaf_of(at);
}

// Twice as large as what it holds, and never flat.
std::array<Rational3, 2> padded_box(const Complex& complex) {
  std::array<Rational3, 2> corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = -1;
    double largest = 1;
    for (std::uint32_t v = 0; v < complex.vertex_count(); ++v) {
      const double x = complex.points.approximate(PointId{v})[axis];
      least = std::min(least, x);
      largest = std::max(largest, x);
    }
    // Much more than the rounding, and than the one that nearest_inside steps back.
    const Rational margin = (exact_rational(largest) - exact_rational(least)) / 2 + 2;
    const Rational low = exact_rational(least) - margin;
    const Rational high = exact_rational(largest) + margin;
    // Whole numbers keep the planes small.
    corners[0][axis] = Rational(floor_of(low));
    corners[1][axis] = Rational(ceiling_of(high));
  }
  return corners;
}

std::array<Rational3, 2> SpaceTree::bounds() const {
  std::array<Rational3, 2> result;
  for (std::size_t i = 0; i < 6; ++i) {
    // Its planes are x - c = 0.
    result[i % 2][i / 2] = -Rational(mpz_class(mpz_srcptr(t_.planes.coefficient(t_.box[i], 3))));
  }
  return result;
}

Rational3 SpaceTree::nearest_inside(const Rational3& point) const {
  const std::array<Rational3, 2> corners = bounds();
  Rational3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = std::clamp(point[i], Rational(corners[0][i] + 1), Rational(corners[1][i] - 1));
  }
  return result;
}

CellId SpaceTree::locate(const ExactPoint& point) const { return t_.leaves[leaf_at(point)].cell; }

}  // namespace nef::planner
