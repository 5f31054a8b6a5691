// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/containment.h"

#include <algorithm>

#include "apps/minkowski/cells/rounded_cells.h"

namespace nef::minkowski {

std::vector<std::uint8_t> held_by_others(std::span<const ConvexCell> cells) {
  const RoundedCells rounded(cells);
  // A cell strictly inside another one is smaller, so there are no cycles: every cell that is
  // dropped lies in one that is kept.
  std::vector<std::uint8_t> held(cells.size(), 0);
  const BoxTree tree(rounded.boxes(), BoxSplit::kMedians);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const auto around = [&](const Box& box) { return box_holds(box, rounded.box(i)); };
    tree.for_each_if(around, [&](std::uint32_t j) {
      if (held[i] != 0 || j == i || rounded.first_face(j) == rounded.end_face(j)) return;
      const std::span<const Double3> v = rounded.vertices(i);
      if (std::all_of(v.begin(), v.end(), [&](const Double3& x) { return rounded.surely_inside(j, x); })) held[i] = 1;
    });
  }
  return held;
}

}  // namespace nef::minkowski
