// SPDX-License-Identifier: Apache-2.0
//
// Queries of the tree; space_tree_builder.cpp makes it.
#include "apps/planner/partition/space_tree.h"

#include <algorithm>

#include "nef/base/error.h"

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
  std::uint32_t at = root_;
  while (!is_leaf(at)) {
    const Node& node = nodes_[at];
    int side = point.side(planes_, node.plane);
    for (std::size_t i = 0; i < nudges.size() && side == 0; ++i) side = side_of_nudge(planes_, node.plane, nudges[i]);
    at = node.child[child_index(side)];
  }
  return leaf_of(at);
}

LeafId SpaceTree::leaf_at(const ExactPoint& point) const {
  const LeafId leaf = leaf_at(point, std::span<const Nudge>{});
  if (leaves_[leaf].cell != kNoCell) return leaf;
  std::uint32_t at = root_;
  while (!is_leaf(at)) {
    const Node& node = nodes_[at];
    at = node.child[child_index(generic_side(point.side(planes_, node.plane)))];
  }
  return leaf_of(at);
}

std::array<Rational3, 2> SpaceTree::bounds() const {
  std::array<Rational3, 2> result;
  for (std::size_t i = 0; i < 6; ++i) {
    // Its planes are x - c = 0.
    result[i % 2][i / 2] = -Rational(mpz_class(mpz_srcptr(planes_.coefficient(box_[i], 3))));
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

CellId SpaceTree::locate(const ExactPoint& point) const { return leaves_[leaf_at(point)].cell; }

}  // namespace nef::planner
