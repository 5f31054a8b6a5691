// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "apps/visual_hull/scene/camera.h"
#include "apps/visual_hull/scene/world_box.h"

namespace nef::visual_hull {

/// Space moved so that the scene lies about the origin, where doubles have digits to spare: at UTM coordinates the
/// filters of predicates fail thousands of times.
struct Place {
  Rational3 shift;  ///< of the origin; zero if the scene is near it
  std::vector<Camera> cameras;

  [[nodiscard]] bool moved() const { return sgn(shift[0]) != 0 || sgn(shift[1]) != 0 || sgn(shift[2]) != 0; }

  [[nodiscard]] WorldBox inward(WorldBox box) const {
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] -= shift[i];
      box.high[i] -= shift[i];
    }
    return box;
  }
  [[nodiscard]] WorldBox outward(WorldBox box) const {
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] += shift[i];
      box.high[i] += shift[i];
    }
    return box;
  }
};

/// Moves cameras that are farther from the origin than from what they look at. Exact.
Place place_of(const std::vector<Camera>& cameras);

}  // namespace nef::visual_hull
