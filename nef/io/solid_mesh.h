// SPDX-License-Identifier: Apache-2.0
//
// The mesh of a set as a file would hold it, for callers that hand it to other programs themselves.
#pragma once

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef {

/// How solid_mesh makes a mesh; the names are those of PolyhedronWriteOptions.
struct SolidMeshOptions {
  bool polygons = false;  ///< keep polygons without holes (with `manifold`: strictly convex ones only)
  bool manifold = false;  ///< each edge has two faces (see separate_sheets)
  bool recenter = false;  ///< subtract middle_of_few_digits (see recenter)
  bool repair = false;    ///< vertices are doubles, at which the mesh is strictly legal; they are exact otherwise
  Monitor monitor = {};   ///< cancellation, progress, counters
};

/// What solid_mesh makes.
struct SolidMesh {
  Mesh mesh;
  Rational3 offset = {};  ///< what was subtracted from all vertices
  Messages notes;         ///< what the mesh does not hold, and what was repaired
};

/// The boundary of the bounded solid parts (see to_mesh). The cost is that of to_mesh; with `repair` that of round_mesh
/// is added. Throws UnsupportedError if the mesh is to be legal after rounding and could not be made so.
SolidMesh solid_mesh(const Polyhedron& set, const SolidMeshOptions& options = {});

}  // namespace nef
