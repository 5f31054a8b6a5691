// SPDX-License-Identifier: Apache-2.0
//
// Meshes that nearly bound a solid.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/import/resolve_mesh.h"

namespace nef {

struct RepairOptions {
  bool fill_holes = false;   ///< close planar holes with a face
  double close_percent = 0;  ///< close all holes, with triangles of least area where they are not planar, if lids have
                             ///< no more than this share in the area of the mesh with its lids
  Crossings crossings = Crossings::kRefuse;  ///< what to do with faces that cross when all else is done
  unsigned threads = 1;                      ///< to use at most; 0: as many as the machine has
};

struct RepairedMesh {
  Mesh mesh;
  std::vector<std::string> done;         ///< a line for each kind of change; empty if nothing was changed
  std::string problem;                   ///< why the mesh bounds no solid still; empty if it does
  std::size_t holes = 0;                 ///< loops of the border when all but lids was done
  std::size_t flat_holes = 0;            ///< of them, with the border of a polygon; with RepairOptions::close_percent
  double lid_share = 0;                  ///< of lids for all of them in the area of the mesh with its lids; likewise
  bool has_lids = false;                 ///< the holes were closed; a guess
  std::optional<ResolvedMesh> resolved;  ///< the solid, with volumes in doubles, where the mesh needed the rule
};

/// Makes the solid of a mesh that means one, without moving a vertex: a mesh that from_mesh takes is left alone.
/// Otherwise vertices at equal points become one, copies of faces go (models with two sides to each face) but for walls
/// between solids (without_copies), faces without area go and the vertices in the sides of their neighbours become
/// corners of these, faces are turned to fit their neighbours, and components that cross no other are turned outward
/// or, inside an odd number of others, inward. Holes whose border lies in a plane are filled if the options say so,
/// and any others by triangles of least area (least_area_triangles).
/// What crosses itself then, or encloses something several times, is resolved by the rule; with a rule, components stay
/// outward inside of others unless some of their faces were turned, as the rule has an answer to them. O(n log n), and
/// a point location for each pair of a component and another in whose box it lies.
RepairedMesh repair_mesh(const Mesh& mesh, const RepairOptions& options = {}, const Monitor& monitor = {});

}  // namespace nef
