// SPDX-License-Identifier: Apache-2.0
//
// What a mesh of parts of a complex does not say of the set.
#pragma once

#include "nef/export/exported_parts.h"
#include "nef/export/mesh_losses.h"

namespace nef {

/// The unbounded volumes that are not in the mesh, and the facets, edges and vertices that are not, or that the mesh
/// has although they do not belong to the set. O(n).
MeshLosses lost_features(const ExportedParts& parts);

}  // namespace nef
