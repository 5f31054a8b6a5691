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
#include "nef/geometry/vectors.h"

namespace visual_hull {

/// The relative error that a few roundings of doubles have, with room.
inline constexpr double kRounding = 0x1p-50;

using nef::cross;
using nef::dot;
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

inline SpotName sorted_name(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  SpotName name{a, b, c};
  std::sort(name.begin(), name.end());
  return name;
}

/// Fixed once made; read by all threads. Refers to the cameras and silhouettes of its inputs.
class EdgeScene : public ExactSpots {
 public:
  /// Nothing if a camera does not have all of the box in front, or a silhouette is degenerate (EdgeView::make).
  static std::unique_ptr<const EdgeScene> make(const std::vector<DirectView>& inputs, const WorldBox& box);
  EdgeScene(const EdgeScene&) = delete;  // its views refer to it
  EdgeScene& operator=(const EdgeScene&) = delete;

  /// Nothing, too, if its planes do not meet in a point, or more exact points were asked for than the way is worth.
  [[nodiscard]] std::optional<Rational3> exact(const Spot& spot) const override;

  /// n . x + d of an edge's plane at a point, and its error.
  [[nodiscard]] double height(const ViewingEdge& edge, const Vec3& at, double at_error, double& error) const;

  /// Makes a named spot as exact as doubles are. False where `exact` gives nothing.
  [[nodiscard]] bool refine(Spot& spot) const;

  /// A length that reaches from a point beyond all of the box.
  [[nodiscard]] double reach(const Vec3& at) const;

  std::vector<EdgeView> views;
  std::vector<ViewingEdge> edges;
  Vec3 low{}, high{};  ///< of the box
  double size = 0;     ///< its longest side

 private:
  EdgeScene() = default;

  mutable std::atomic<std::size_t> exact_spots_ = 0;
  std::size_t exact_budget_ = 0;
};

}  // namespace visual_hull
