// SPDX-License-Identifier: Apache-2.0
//
// The last step of a repair: components that are inside out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/crossings.h"
#include "nef/import/repair/repair_steps.h"
#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// The faces of each component of the mesh: faces that share sides. O(n) expected.
std::vector<std::vector<std::uint32_t>> components_by_sides(const MeshInRepair& mesh);

/// Turns components that cross no other and bound a solid: outward or, inside an odd number of others, inward. With a
/// rule for crossings, one that is turned outward stays so unless some of its faces were turned to fit their
/// neighbours, as the rule has an answer to it. `contacts` are those of the faces. Returns how many were turned.
/// Imports the components that may be turned and those around them, and locates a point for each such pair.
std::size_t turn_components(MeshInRepair& mesh, std::span<const std::vector<std::uint32_t>> components,
                            std::span<const FaceContact> contacts, Crossings rule, const Monitor& monitor);

}  // namespace nef
