// SPDX-License-Identifier: Apache-2.0
//
// From the items of a cut polyhedron back to those of the polyhedron itself.
#pragma once

#include "apps/view/scene.h"

namespace nef::view {

/// Replaces the indices of a scene, which count the items of the cut complex `drawn`, by those of scene.source: by
/// exact location of a point inside each item. Items made by the cut become kArtificial. O(log n) expected for each.
void find_items(const Complex& drawn, Scene& scene, const Monitor& monitor);

/// Makes all indices kArtificial.
void forget_items(Scene& scene);

}  // namespace nef::view
