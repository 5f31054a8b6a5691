// SPDX-License-Identifier: Apache-2.0
//
// What a rule for crossings did to a mesh, in words.
#pragma once

#include <string>
#include <vector>

#include "nef/import/resolve_mesh.h"

namespace nef {

/// A line about the crossings, and one for each winding number other than 0 and 1: how many parts, their volume and its
/// share of the solid's, and whether they are in the solid. Volumes must have been measured by Measure::kDoubles.
std::vector<std::string> lines_about(const ResolvedMesh& resolved, Crossings rule);

}  // namespace nef
