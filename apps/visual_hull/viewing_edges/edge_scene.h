// SPDX-License-Identifier: Apache-2.0
//
// All views of the direct way together, and what it asks of planes and points.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

#include "apps/visual_hull/viewing_edges/direct_hull.h"
#include "apps/visual_hull/viewing_edges/edge_view.h"

namespace nef::visual_hull {

/// What sums of at most four products of doubles lose, as a part of the sum of magnitudes: at most 5 roundings of
/// 2^-53, and room for those of the bounds.
inline constexpr double kRounding = 0x1p-50;

inline SpotName sorted_name(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  SpotName name{a, b, c};
  std::sort(name.begin(), name.end());
  return name;
}

/// Fixed once made; read by all threads. Refers to the cameras and silhouettes of its inputs.
class EdgeScene {
 public:
  /// Nothing if a camera does not have all of the box in front, or a silhouette is degenerate (EdgeView::make).
  static std::unique_ptr<const EdgeScene> make(const std::vector<DirectView>& inputs, const WorldBox& box,
                                               const nef::Monitor& monitor);
  EdgeScene(const EdgeScene&) = delete;  // its views refer to it
  EdgeScene& operator=(const EdgeScene&) = delete;

  /// The point of three planes; nothing if they do not meet in a point.
  [[nodiscard]] std::optional<ExactPoint> exact(const SpotName& name) const;

  /// Counts an exact point; false if there were more than the way is worth.
  [[nodiscard]] bool may_be_exact() const {
    // A sum over all threads, so whether it is exceeded does not depend on them.
    return exact_points_.fetch_add(1, std::memory_order_relaxed) < exact_budget_;
  }

  std::vector<EdgeView> views;
  std::vector<ViewingEdge> edges;
  Double3 low{}, high{};  ///< of the box
  Double3 farthest{};     ///< the largest coordinates of its points

 private:
  EdgeScene() = default;

  mutable std::atomic<std::size_t> exact_points_ = 0;
  std::size_t exact_budget_ = 0;
};

}  // namespace nef::visual_hull
