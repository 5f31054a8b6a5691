// SPDX-License-Identifier: Apache-2.0
//
// Convex solids by the names of vertices and planes of a complex, and their merging where a wall between
// them turned out not to be needed (a wall of one reflex edge often serves others, too).
#pragma once

#include <cstdint>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/complex/complex.h"

namespace nef::minkowski {

/// A convex solid: extreme vertices only, no two faces in one plane.
struct CellBody {
  struct Face {
    std::vector<std::uint32_t> ring;  ///< vertices of the complex, counterclockwise from outside
    PlaneId plane;                    ///< positive side outside
  };
  std::vector<Face> faces;
};

/// The closed cell. O(n).
ConvexCell to_cell(const Complex& complex, const CellBody& body);

/// Unites pairs of bodies that have a whole face in common and whose union is convex until there are none. The
/// union of all stays the same, and so does whether their interiors are disjoint. The first body of each
/// union keeps its place. O(n log n) for bodies with faces of bounded size.
std::vector<CellBody> merged(const Complex& complex, std::vector<CellBody> bodies, const Monitor& monitor);

}  // namespace nef::minkowski
