// SPDX-License-Identifier: Apache-2.0
//
// Which cells a segment runs through. It is the inner loop of every motion check, so the visitor is a template
// parameter, and nothing is allocated unless doubles cannot decide.
#pragma once

#include "apps/planner/partition/space_tree.h"

namespace nef::planner {

/// A part of a segment inside one leaf: a single parameter (begin == end) or the open interval between two. The
/// parameters live as long as the call of the visitor.
struct SegmentPart {
  CellId cell = kNoCell;
  bool is_point = false;
  const SegmentParameter& begin;
  const SegmentParameter& end;
};

/// One walk along a segment, in order of the parameter.
template <typename Visit>
class SegmentWalk {
 public:
  SegmentWalk(const SpaceTree& tree, const ExactPoint& a, const ExactPoint& b, Visit& visit)
      : tree_(tree), segment_(tree.planes(), a, b), visit_(visit) {}

  void run() {
    const SegmentParameter begin = ExactSegment::fixed(0);
    const SegmentParameter end = ExactSegment::fixed(1);
    if (point(tree_.root(), begin) && interval(tree_.root(), begin, end)) point(tree_.root(), end);
  }

 private:
  [[nodiscard]] std::uint32_t child(std::uint32_t node, int side) const {
    return tree_.nodes()[node].child[static_cast<std::size_t>(side) + 1];
  }
  [[nodiscard]] int side(std::uint32_t node, const SegmentParameter& t) const {
    return segment_.side(segment_.forms(tree_.nodes()[node].plane), t);
  }

  bool point(std::uint32_t at, const SegmentParameter& t) {
    while (!SpaceTree::is_leaf(at)) at = child(at, side(at, t));
    CellId cell = tree_.leaves()[SpaceTree::leaf_of(at)].cell;
    if (cell == kNoCell) {
      // Inside a volume: the one that the walk is in already, except at the very beginning.
      if (t.plane.valid() || t.direction != 0) return true;
      cell = volume_beside(t, t);
    }
    return visit_(SegmentPart{cell, true, t, t});
  }

  bool interval(std::uint32_t at, SegmentParameter begin, const SegmentParameter& end) {
    while (!SpaceTree::is_leaf(at)) {
      const ExactSegment::PlaneForms forms = segment_.forms(tree_.nodes()[at].plane);
      const int first = segment_.side(forms, begin);
      const int last = segment_.side(forms, end);
      if (first * last >= 0) {
        at = child(at, first != 0 ? first : last);
        continue;
      }
      // The form falls or rises along the whole segment as it does here.
      const SegmentParameter middle = ExactSegment::crossing(forms, first);
      if (!interval(child(at, first), begin, middle) || !point(child(at, 0), middle)) return false;
      begin = middle;
      at = child(at, last);
    }
    CellId cell = tree_.leaves()[SpaceTree::leaf_of(at)].cell;
    if (cell == kNoCell) cell = volume_beside(begin, end);
    return visit_(SegmentPart{cell, false, begin, end});
  }

  // The volume around a point, or around an open interval that no plane above its leaf cuts. Unflipped normals have a
  // positive first component, so one generic direction is above each plane that holds all of it. Planes beside the
  // leaf's own ancestors may cut the interval: its begin decides then, consistently, as if the point just after it
  // had been asked.
  [[nodiscard]] CellId volume_beside(const SegmentParameter& begin, const SegmentParameter& end) const {
    std::uint32_t at = tree_.root();
    while (!SpaceTree::is_leaf(at)) {
      int s = side(at, begin);
      if (s == 0) s = side(at, end);
      at = child(at, s == 0 ? 1 : s);
    }
    return tree_.leaves()[SpaceTree::leaf_of(at)].cell;
  }

  const SpaceTree& tree_;
  ExactSegment segment_;
  Visit& visit_;
};

/// Calls visit(SegmentPart) for the parts of the segment from a to b in order, a included as a point, and b unless it
/// is inside the volume that the segment ends in; the points must differ. Stops when visit returns false. Consecutive
/// parts may be in the same cell. O(depth of the tree times parts) signs, each a few nanoseconds where doubles decide.
template <typename Visit>
void walk_segment(const SpaceTree& tree, const ExactPoint& a, const ExactPoint& b, Visit&& visit) {
  SegmentWalk<std::remove_reference_t<Visit>>(tree, a, b, visit).run();
}

}  // namespace nef::planner
