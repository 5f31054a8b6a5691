// SPDX-License-Identifier: Apache-2.0
//
// The sphere map of a vertex as things to draw on a unit sphere.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/complex/complex.h"

namespace nef::view {

/// Indices are local to the vertex unless they say otherwise. Doubles are within a few units in the last place.
struct SphereDrawing {
  struct Dot {
    std::array<double, 3> direction{};  ///< of unit length
    LabelId mark = 0;
    std::uint32_t halfedge = 0;  ///< of the complex
  };
  /// From `source` counterclockwise about `normal` to `target`; up to a full circle if both are one.
  struct Arc {
    std::uint32_t source = 0;
    std::uint32_t target = 0;
    std::array<double, 3> normal{};
    LabelId mark = 0;
    std::uint32_t facet = 0;  ///< of the complex
    std::uint32_t left = 0;   ///< sface on the side of the normal
    std::uint32_t right = 0;
  };
  struct Circle {
    std::array<double, 3> normal{};
    LabelId mark = 0;
    std::uint32_t facet = 0;
    std::uint32_t left = 0;
    std::uint32_t right = 0;
  };
  struct Region {
    LabelId mark = 0;
    std::uint32_t volume = 0;  ///< of the complex
  };
  std::vector<Dot> dots;
  std::vector<Arc> arcs;
  std::vector<Circle> circles;
  std::vector<Region> regions;
  LabelId mark = 0;  ///< of the vertex
};

/// O(size of the sphere map).
SphereDrawing draw_sphere_map(const Complex& complex, VertexId vertex);

}  // namespace nef::view
