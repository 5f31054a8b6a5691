// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "apps/visual_hull/scene/camera.h"

namespace nef::visual_hull {

/// The planes of one camera, in integers: as plane_through, but for a positive factor, and some twenty times as fast
/// where image points are on the lattice. Keeps a reference to the camera.
class CameraPlanes {
 public:
  explicit CameraPlanes(const Camera& camera);

  /// a, b, c and d of the plane a x + b y + c z + d = 0 that is seen as the line from `a` to `b`.
  [[nodiscard]] std::array<Integer, 4> through(const Point2& a, const Point2& b) const;

 private:
  const Camera& camera_;
  std::array<std::array<Integer, 4>, 3> matrix_;  // times a common denominator
};

}  // namespace nef::visual_hull
