// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/facets/rounded_facets.h"

#include <algorithm>
#include <cmath>

#include "nef/base/threads/parallel.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::minkowski {

RoundedFacets::RoundedFacets(const ConvolutionFacets& facets, const Monitor& monitor)
    : facets_(facets), planes_(facets.size()), sides_(facets.corners.size()), boxes_(facets.size()) {
  for (const Double3& p : facets.rounded) {
    for (const double x : p) extent_ = std::max(extent_, std::fabs(x));
  }
  constexpr std::size_t kRange = 4096;
  parallel_for_ranges(facets.size(), kRange, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
    for (auto f = static_cast<std::uint32_t>(from); f < to; ++f) {
      const auto ring = facets.ring(f);
      const auto [i, j] = far_corners(f);
      planes_[f] = rounded_plane(facets.rounded[ring[0]], facets.rounded[ring[i]], facets.rounded[ring[j]], extent_);
      for (const std::uint32_t c : ring) boxes_[f].add_rounded(facets.rounded[c]);
      find_sides(f);
    }
  });
}

// Two corners that span about the largest triangle with the first one: it may be next to straight corners.
std::array<std::size_t, 2> RoundedFacets::far_corners(std::uint32_t f) const {
  const auto ring = facets_.ring(f);
  const Double3& o = facets_.rounded[ring[0]];
  std::array<std::size_t, 2> best{1, 2};
  double largest = 0;
  for (std::size_t j = 2; j < ring.size(); ++j) {
    for (const std::size_t i : {std::size_t{1}, j / 2, j - 1}) {
      const Double3& p = facets_.rounded[ring[i]];
      const Double3& q = facets_.rounded[ring[j]];
      double area = 0;
      for (std::size_t u = 0; u < 3; ++u) {
        const std::size_t v = (u + 1) % 3;
        area += std::fabs((p[u] - o[u]) * (q[v] - o[v]) - (p[v] - o[v]) * (q[u] - o[u]));
      }
      if (i >= j || area <= largest) continue;
      largest = area;
      best = {i, j};
    }
  }
  return best;
}

// Corners are within e = 4u extent of the truth, with room, so a side has components within 2.5 e, and x - origin, at
// most 2 extent in each coordinate, is within 1.1 e if x is exact. Two products and a sum round by 4u of the
// magnitudes. Nothing overflows for moderate extents, and what vanishes is far below e extent.
void RoundedFacets::find_sides(std::uint32_t f) {
  const auto [axis, turn] = projection_axis(facets_.planes, facets_.plane[f]);
  const auto ring = facets_.ring(f);
  const double e = corner_error();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Double3& from = facets_.rounded[ring[i]];
    const Double3& to = facets_.rounded[ring[i + 1 < ring.size() ? i + 1 : 0]];
    RoundedSide& side = sides_[facets_.begin[f] + i];
    side.u = static_cast<std::uint32_t>((axis + 1) % 3);
    side.v = static_cast<std::uint32_t>((axis + 2) % 3);
    side.normal_u = -turn * (to[side.v] - from[side.v]);
    side.normal_v = turn * (to[side.u] - from[side.u]);
    side.origin_u = from[side.u];
    side.origin_v = from[side.v];
    side.weight = 1.1 * (std::fabs(side.normal_u) + std::fabs(side.normal_v)) + 5 * e;
    side.slack = 12 * e * extent_ + 2 * side.weight * e + 16 * kUnit * side.weight * extent_ + 1e-290;
  }
}

}  // namespace nef::minkowski
