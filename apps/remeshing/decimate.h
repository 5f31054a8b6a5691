// SPDX-License-Identifier: Apache-2.0
//
// Meshes with fewer triangles that are still legal.
#pragma once

#include <cstddef>

#include "apps/remeshing/hausdorff.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef {

struct DecimatedMesh {
  Mesh mesh;                ///< triangles; its vertices are vertices of the set, coordinates and all
  DistanceBounds distance;  ///< Hausdorff distance of its surface and the set's
  Messages notes;           ///< what a mesh does not hold of the set; if there are more triangles than asked for, why
};

/// A mesh of about `triangles` triangles for the solid parts of a set, by collapsing edges of its mesh in the order of
/// their quadric errors [Garland, Heckbert 1997] (OpenMesh does the work). from_mesh takes the result: where fewer
/// triangles would cross each other, more of them stay. Sheets that meet in an edge or a vertex keep both. Throws
/// InputError if the set has no bounded solid part. O(n log n) for n triangles, and a check of legality for each
/// attempt.
DecimatedMesh decimate(const Polyhedron& set, std::size_t triangles, const Monitor& monitor = {});

}  // namespace nef
