// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/cones/at_least.h"

#include <algorithm>

#include "nef/labeled_polyhedron.h"

namespace visual_hull {

nef::Polyhedron in_at_least(std::span<const nef::Polyhedron> cones, std::size_t least, const nef::Polyhedron& room,
                            const nef::Monitor& monitor) {
  // The label of a point: in how many cones it is, up to `least`; kOut if it cannot be in enough any more.
  constexpr int kOut = -1;
  using Counted = nef::LabeledPolyhedron<int>;
  const int wanted = static_cast<int>(least);
  if (least == 0) return room;
  if (least > cones.size() || room.is_empty()) return {};
  Counted counted(room, kOut, 0);
  int left = static_cast<int>(cones.size());
  for (const nef::Polyhedron& cone : cones) {
    --left;
    const Counted held(cone, 0, 1);
    const auto add = [wanted, left](int count, int more) {
      if (count == kOut) return kOut;
      const int sum = std::min(count + more, wanted);
      return sum + left < wanted ? kOut : sum;
    };
    counted = overlay(counted, held, add, monitor);
  }
  return counted.where([wanted](int count) { return count == wanted; }, monitor);
}

}  // namespace visual_hull
