// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/remeshing/triangle_mesh.h"

namespace nef {

/// The largest quadric error that each vertex of a mesh may take part in; infinite: any, negative: it stays as it is.
using CollapseLimits = std::vector<float>;

/// What became of each vertex.
struct Collapses {
  std::vector<std::uint32_t> into;  ///< the vertex that stands for it now; itself if it is there still
  std::vector<float> error;         ///< of vertices that are there: the largest of what was collapsed into them
};

/// Collapses edges by their quadric error [Garland, Heckbert 1997] (OpenMesh does the work) until so many triangles are
/// left or no edge can be collapsed without turning a face over or passing a limit; what goes is marked as deleted.
/// Borders stay as they are. There are as many `limits` as vertices. O(n log n).
Collapses collapse_edges(TriangleMesh& work, std::size_t triangles, const CollapseLimits& limits);

}  // namespace nef
