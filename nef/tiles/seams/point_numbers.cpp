// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/seams/point_numbers.h"

#include <utility>

#include "nef/sphere_map/sphere_map.h"

namespace nef {

std::uint32_t PointNumbers::number(const PointTable& from, PointId point) {
  if (2 * (used_ + 1) > slots_.size()) grow();
  std::size_t slot = from.hash(point) & (slots_.size() - 1);
  for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
    if (points_.identical(PointId{slots_[slot]}, from, point)) return slots_[slot];
  }
  ++used_;
  slots_[slot] = points_.push_from(from, point).index();
  return slots_[slot];
}

void PointNumbers::grow() {
  const std::vector<std::uint32_t> old = std::exchange(slots_, {});
  slots_.assign(old.empty() ? 1024 : 2 * old.size(), kNone);
  for (const std::uint32_t number : old) {
    if (number == kNone) continue;
    std::size_t slot = points_.hash(PointId{number}) & (slots_.size() - 1);
    while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = number;
  }
}

}  // namespace nef
