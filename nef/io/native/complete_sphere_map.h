// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps from files that somebody may have made up.
#pragma once

#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// Finds `prev` of all shalfedges, which must be kNone, and asks all that walks over a sphere map rely on to stay
/// inside of it and to come to an end: items exist, next and prev are inverse to each other, turns around svertices
/// come back, and sfaces have the entries that lie on them. What is wrong, for a message, or null. O(n).
const char* complete_sphere_map(SphereMapBuffer& map);

}  // namespace nef
