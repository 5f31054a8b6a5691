// SPDX-License-Identifier: Apache-2.0
//
// Meshes with more triangles.
#pragma once

#include <cstdint>

#include "nef/construct/construct.h"

namespace nef {

enum class SubdivisionScheme : std::uint8_t {
  kMidpoint,  ///< new vertices in the middle of edges, exactly: the same surface
  kLoop,      ///< the surface is smoothed [Loop 1987]; coordinates are doubles (OpenMesh does the work)
};

/// Each triangle in four, `times` times; faces of more corners are refused, as are, with Loop's scheme, edges of more
/// than two triangles and vertices at which several sheets meet (InputError). With the midpoint scheme the mesh stays
/// as legal as it was; a smoothed one may cross itself. Deterministic. O(4^times n).
Mesh subdivide(const Mesh& triangles, SubdivisionScheme scheme, unsigned times);

}  // namespace nef
