// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef {

/// The volume that the faces of a closed mesh enclose with their signs, in doubles with a proven bound: the sum of
/// winding number times volume over all of space. Its faces count as the triangles into which import cuts them. O(n log
/// n).
MeasuredVolume signed_volume(const Mesh& mesh, const Monitor& monitor = {});

}  // namespace nef
