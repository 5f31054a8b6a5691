// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps of vertices as the arrays that pages have of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/view/page/sphere_drawing.h"

namespace nef::view {

/// Maps one behind the other; `begin` has, for each and one more, where its dots, arcs, circles and regions begin. A
/// dot has a mark and a halfedge; an arc source, target, mark, facet and the sfaces to both sides; a circle mark, facet
/// and sfaces; a region mark and volume. Directions are in units of 1/32767.
struct SphereArrays {
  std::vector<std::uint32_t> begin{0, 0, 0, 0};
  std::vector<std::int16_t> directions;
  std::vector<std::int16_t> normals;
  std::vector<std::int16_t> circle_normals;
  std::vector<std::uint32_t> dots;
  std::vector<std::uint32_t> arcs;
  std::vector<std::uint32_t> circles;
  std::vector<std::uint32_t> regions;

  /// Adds one; an empty one for a vertex that has none. O(its size).
  void add(const SphereDrawing& drawing);
};

}  // namespace nef::view
