// SPDX-License-Identifier: Apache-2.0
//
// The items of a complex by where they are: what a segment may meet is found without any partition of space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "nef/complex/complex.h"
#include "nef/complex/item_ref.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::planner {

/// A box tree over all facets, the edges on no facet and the vertices on no edge or facet: every point of the boundary
/// lies in the box of one of them. For complexes without infimaximal box. O(n log n) to build; keeps no reference.
class ItemTree {
 public:
  explicit ItemTree(const Complex& complex);

  /// Calls visit(item) for all items whose boxes meet the segment, and maybe a few others, until it returns false.
  template <typename Visit>
  void for_each_along(const Vector3d& a, const Vector3d& b, Visit&& visit) const {
    const Reach reach(a, b);
    bool more = true;
    tree_.for_each_if([&](const Box& box) { return more && reach.may_meet(box); },
                      [&](std::uint32_t i) { more = visit(items_[i]); });
  }
  /// Calls visit(item) for all items whose boxes `accept` takes; it must take a box if it takes one inside it.
  template <typename Accept, typename Visit>
  void for_each_if(const Accept& accept, Visit&& visit) const {
    tree_.for_each_if(accept, [&](std::uint32_t i) { visit(items_[i]); });
  }

 private:
  // A segment whose ends are known to 2^-53 of their coordinates. "Meets a box" errs to yes.
  class Reach {
   public:
    Reach(const Vector3d& a, const Vector3d& b);
    [[nodiscard]] bool may_meet(const Box& box) const;

   private:
    Box box_;
    Vector3d from_;
    Vector3d along_;
    Vector3d size_;
  };

  std::vector<ItemRef> items_;
  BoxTree tree_;
};

}  // namespace nef::planner
