// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/seams/point_numbers.h"

#include "nef/sphere_map/sphere_map.h"

namespace nef {

std::uint32_t PointNumbers::number(const PointTable& from, PointId point) {
  if (2 * (points_.size() + 1) > slots_.size()) grow();
  std::size_t slot = from.hash(point) & (slots_.size() - 1);
  for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
    if (points_.identical(PointId{slots_[slot]}, from, point)) return slots_[slot];
  }
  slots_[slot] = points_.push_from(from, point).index();
  return slots_[slot];
}

void PointNumbers::grow() {
  slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), kNone);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    std::size_t slot = points_.hash(PointId{i}) & (slots_.size() - 1);
    while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = i;
  }
}

}  // namespace nef
