// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nef/remeshing/triangle_mesh.h"

namespace nef {

/// Collapses edges by their quadric error [Garland, Heckbert 1997] (OpenMesh does the work) until so many triangles are
/// left or no edge can be collapsed without turning a face over; what goes is marked as deleted. Borders stay as they
/// are. O(n log n).
void collapse_edges(TriangleMesh& work, std::size_t triangles);

}  // namespace nef
