// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers of surfaces that are not closed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh.h"

namespace nef {

/// How often the triangles of a surface wind around a point: the sum of their solid angles over that of the sphere
/// [Jacobson, Kavan, Sorkine-Hornung 2013]. An integer, up to rounding, for a closed surface; anything for one with
/// holes. In doubles without a bound: for guesses.
class GeneralizedWinding {
 public:
  GeneralizedWinding(const Mesh& mesh, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// O(triangles). The point should not lie on the surface.
  [[nodiscard]] double around(const Rational3& point) const;

 private:
  std::vector<std::array<Double3, 3>> corners_;  // of each triangle
};

}  // namespace nef
