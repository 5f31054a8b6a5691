// SPDX-License-Identifier: Apache-2.0
//
// With heights over two planes f and g: f > 0 wherever g >= 0 in a box if f - l g > 0 in all of it for some l >= 0, and
// that is so if the height of its middle exceeds the sum of what it falls by along the axes.
#include "apps/visual_hull/viewing_edges/part_cut.h"

#include <algorithm>
#include <cmath>

namespace nef::visual_hull {
namespace {

// What sums here and in halving may lose, as a part of the sum S of the magnitudes in them. u = 2^-53.
// - The height of a point: a product rounds once, three sums at most three times: 4u.
// - positive(), where S is that of f and l times that of g: two heights 4u, two slopes u, l times a height and the
//   difference 2u, the differences of slopes 2u, and three more differences of at most 2S each 6u: 15u. Any l will do,
//   so its own rounding does not count.
// - runs_across(): differences u each, product and sum 2u, and the ends are off by u themselves: (m - a) d is off by
//   |m - a| u (|a| + |b|) for that. The plane passes the part, so m is no farther from the line than the window's half
//   diagonal; where the answer is yes, that is below the edge's length |d|, and |m - a| below 3 |d|: 3u (|a| + |b|)
//   |d|.
// Each is below 2^-48; much more costs nothing, as it is still far below the size of a part.
constexpr double kSlack = 1e-10;

// Whether a segment passes all of a window in which its line is seen.
bool runs_across(const ViewingEdge& edge, const EdgeView::Window& window) {
  const auto& a = edge.from->approximate;
  const auto& b = edge.to->approximate;
  double along = 0;  // of the middle, times the length
  double spread = 0;
  double square = 0;
  double rounding = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double d = b[k] - a[k];
    along += (window.middle[k] - a[k]) * d;
    spread += window.half[k] * std::abs(d);
    square += d * d;
    rounding += (std::abs(window.middle[k]) + std::abs(a[k]) + std::abs(b[k])) * std::abs(d) * kSlack;
  }
  return along - spread > rounding && along + spread < square - rounding;
}

}  // namespace

std::vector<PartFacet> facets_of(const EdgeScene& scene) {
  std::vector<PartFacet> facets;
  facets.reserve(scene.edges.size());
  for (const ViewingEdge& edge : scene.edges) {
    PartFacet facet;
    const auto& a = edge.from->approximate;
    const auto& b = edge.to->approximate;
    for (std::size_t k = 0; k < 2; ++k) {
      facet.low[k] = std::min(a[k], b[k]);
      facet.high[k] = std::max(a[k], b[k]);
    }
    facet.normal = edge.normal.at;
    facet.offset = edge.offset;
    double size = std::abs(edge.offset);
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      size += std::abs(edge.normal.at[k]) * scene.farthest[k];
      reach += scene.farthest[k];
    }
    facet.error = size * kSlack + edge.offset_error + reach * edge.normal.error;
    facets.push_back(facet);
  }
  return facets;
}

std::optional<PartCut> PartCut::make(std::uint32_t view, const PartFacet& facet, const ViewingEdge& edge,
                                     const PartBox& box, const EdgeView::Window& window) {
  PartCut cut;
  cut.view_ = view;
  cut.box_ = box;
  cut.height_ = facet.height(box.middle);
  cut.error_ = facet.error;
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    cut.slope_[k] = facet.normal[k] * box.half[k];
    reach += std::abs(cut.slope_[k]);
  }
  constexpr double kWithin = 0.99;  // of the way from the middle to a corner
  const bool passes = std::abs(cut.height_) < kWithin * reach - 2 * facet.error;
  if (!passes || !runs_across(edge, window)) return std::nullopt;
  cut.share_ = 1 + cut.height_ / reach;
  for (std::size_t k = 0; k < 3; ++k) {
    cut.point_[k] = box.middle[k] + std::copysign(kWithin * box.half[k], facet.normal[k]);
  }
  return cut;
}

// Linear in pieces, and concave, in the factor: the best one is where a component of the difference vanishes.
bool PartCut::positive(double height, const Double3& slope, double error) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const double factor = slope[k] / slope_[k];
    if (!(factor > 0)) continue;
    double least = height - factor * height_ - (error + factor * error_);
    for (std::size_t m = 0; m < 3; ++m) least -= std::abs(slope[m] - factor * slope_[m]);
    if (least > 0) return true;
  }
  return false;
}

bool PartCut::misses(const PartFacet& facet) const {
  Double3 slope{};
  for (std::size_t k = 0; k < 3; ++k) slope[k] = facet.normal[k] * box_.half[k];
  const double height = facet.height(box_.middle);
  if (positive(height, slope, facet.error)) return true;
  for (double& s : slope) s = -s;
  return positive(-height, slope, facet.error);
}

}  // namespace nef::visual_hull
