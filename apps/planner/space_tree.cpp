// SPDX-License-Identifier: Apache-2.0
//
// Queries of the tree; space_tree_builder.cpp makes it.
#include "apps/planner/space_tree.h"

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

}  // namespace

LeafId SpaceTree::leaf_at(const ExactPoint& point, std::span<const Nudge> nudges) const {
  std::uint32_t at = root_;
  while (!is_leaf(at)) {
    const Node& node = nodes_[at];
    int side = point.side(planes_, node.plane);
    for (std::size_t i = 0; i < nudges.size() && side == 0; ++i) side = side_of_nudge(planes_, node.plane, nudges[i]);
    at = node.child[static_cast<std::size_t>(side + 1)];
  }
  return leaf_of(at);
}

LeafId SpaceTree::leaf_at(const ExactPoint& point) const {
  const LeafId leaf = leaf_at(point, std::span<const Nudge>{});
  if (leaves_[leaf].cell != kNoCell) return leaf;
  std::uint32_t at = root_;
  while (!is_leaf(at)) {
    const Node& node = nodes_[at];
    at = node.child[static_cast<std::size_t>(generic_side(point.side(planes_, node.plane)) + 1)];
  }
  return leaf_of(at);
}

CellId SpaceTree::locate(const ExactPoint& point) const { return leaves_[leaf_at(point)].cell; }

/// One walk along a segment: in order of the parameter, each part in its leaf.
class SegmentWalk {
 public:
  SegmentWalk(const SpaceTree& tree, const ExactPoint& a, const ExactPoint& b,
              const std::function<bool(SegmentPart&)>& visit)
      : tree_(tree), segment_(tree.planes_, a, b), visit_(visit) {}

  bool point(std::uint32_t at, SegmentParameter& t) {
    while (!SpaceTree::is_leaf(at)) at = child(at, side(at, t));
    LeafId leaf = SpaceTree::leaf_of(at);
    if (tree_.leaves_[leaf].cell == kNoCell) leaf = generic_leaf_of_point(t);
    return report(leaf, true, t, t);
  }

  bool interval(std::uint32_t at, SegmentParameter& begin, SegmentParameter& end) {
    while (!SpaceTree::is_leaf(at)) {
      const PlaneId plane = tree_.nodes_[at].plane;
      const int first = segment_.side(plane, begin);
      const int last = segment_.side(plane, end);
      if (first * last < 0) {
        SegmentParameter middle = segment_.crossing(plane);
        return interval(child(at, first), begin, middle) && point(child(at, 0), middle) &&
               interval(child(at, last), middle, end);
      }
      at = child(at, first != 0 ? first : last);
    }
    LeafId leaf = SpaceTree::leaf_of(at);
    if (tree_.leaves_[leaf].cell == kNoCell) leaf = generic_leaf_of_interval(begin, end);
    return report(leaf, false, begin, end);
  }

 private:
  [[nodiscard]] std::uint32_t child(std::uint32_t node, int side) const {
    return tree_.nodes_[node].child[static_cast<std::size_t>(side + 1)];
  }
  int side(std::uint32_t node, SegmentParameter& t) { return segment_.side(tree_.nodes_[node].plane, t); }

  LeafId generic_leaf_of_point(SegmentParameter& t) {
    std::uint32_t at = tree_.root_;
    while (!SpaceTree::is_leaf(at)) at = child(at, generic_side(side(at, t)));
    return SpaceTree::leaf_of(at);
  }
  // The side of the open interval, which no plane above this leaf cuts.
  LeafId generic_leaf_of_interval(SegmentParameter& begin, SegmentParameter& end) {
    std::uint32_t at = tree_.root_;
    while (!SpaceTree::is_leaf(at)) {
      int s = side(at, begin);
      const int last = side(at, end);
      // Planes beside this leaf's own ancestors may cut the interval: its begin decides then,
      // consistently, as if the point just after it had been asked.
      if (s == 0) s = last;
      at = child(at, generic_side(s));
    }
    return SpaceTree::leaf_of(at);
  }
  bool report(LeafId leaf, bool is_point, SegmentParameter& begin, SegmentParameter& end) {
    SegmentPart part{tree_.leaves_[leaf].cell, leaf, is_point, begin, end};
    return visit_(part);
  }

  const SpaceTree& tree_;
  ExactSegment segment_;
  const std::function<bool(SegmentPart&)>& visit_;
};

void SpaceTree::walk(const ExactPoint& a, const ExactPoint& b, const std::function<bool(SegmentPart&)>& visit) const {
  SegmentWalk walk(*this, a, b, visit);
  SegmentParameter begin = ExactSegment::fixed(0);
  SegmentParameter end = ExactSegment::fixed(1);
  if (!walk.point(root_, begin)) return;
  if (!walk.interval(root_, begin, end)) return;
  walk.point(root_, end);
}

}  // namespace nef::planner
