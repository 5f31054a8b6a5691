// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/surface/terrains.h"

#include <bit>

namespace nef {

Terrains::Terrains(const MeshPoints& points, const VertexStars& stars, std::span<const VertexStars::Triangle> triangles,
                   const Monitor& monitor)
    : stars_(stars), triangles_(triangles), monitor_(monitor), test_(points), round_of_(triangles.size(), 0) {}

bool Terrains::is_terrain(std::span<const std::uint32_t> triangles) {
  unsigned views = VertexStars::kAllViews;
  for (const std::uint32_t t : triangles) {
    views &= stars_.views(t);
    if (views == 0) return false;
  }
  collect_border(triangles);
  if (border_.size() > triangles.size()) return false;  // small pieces beside each other
  const int view = std::countr_zero(views);
  try {
    return test_.surrounds_once(border_, static_cast<std::size_t>(view / 2), view % 2 == 0 ? 1 : -1, monitor_);
  } catch (const OpenQuestion&) {
    return false;
  }
}

// The sides of the triangles without those that two of them share.
void Terrains::collect_border(std::span<const std::uint32_t> triangles) {
  ++round_;
  for (const std::uint32_t t : triangles) round_of_[t] = round_;
  border_.clear();
  for (const std::uint32_t t : triangles) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t other = stars_.across(t, k);
      if (other != VertexStars::kNone && round_of_[other] == round_) continue;
      border_.push_back({triangles_[t][k], triangles_[t][k == 2 ? 0 : k + 1]});
    }
  }
}

}  // namespace nef
