// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nef/mesh/mesh.h"

namespace nef {

/// A mesh of triangles without edges or vertices at which several sheets meet, and for each of its vertices the one
/// that it was.
struct Sheets {
  Mesh mesh;
  std::vector<std::uint32_t> original;
};

/// Gives each sheet at a vertex a vertex of its own: corners are of one sheet if edges of exactly two faces lead from
/// one to the other. O(n).
Sheets sheets_of(const Mesh& triangles);

}  // namespace nef
