// SPDX-License-Identifier: Apache-2.0
//
// Meshes that nearly bound a solid.
#pragma once

#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef {

struct RepairOptions {
  bool fill_holes = false;  ///< close planar holes with a face
};

struct RepairedMesh {
  Mesh mesh;
  std::vector<std::string> done;  ///< a line for each kind of change; empty if nothing was changed
  std::string problem;            ///< why the mesh bounds no solid still; empty if it does
};

/// Makes the solid of a mesh that means one, without moving a vertex: a mesh that from_mesh takes is left alone.
/// Otherwise vertices at equal points become one, copies of faces go (models with two sides to each face) but for walls
/// between solids (without_copies), faces without area go and the vertices in the sides of their neighbours become
/// corners of these, faces are turned to fit their neighbours, and components are turned outward or, inside an odd
/// number of others, inward. Holes whose border lies in a plane are filled if the options say so. O(n log n), and a
/// point location for each pair of a component and another in whose box it lies.
RepairedMesh repair_mesh(const Mesh& mesh, const RepairOptions& options = {}, const Monitor& monitor = {});

}  // namespace nef
