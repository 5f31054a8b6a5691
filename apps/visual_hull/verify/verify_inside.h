// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "apps/visual_hull/scene/camera.h"
#include "nef/forward.h"

namespace nef::visual_hull {

/// Exact: what of the hull does not project into the silhouette; empty if nothing. See verify_view.
std::string why_outside(const nef::Polyhedron& hull, const Camera& camera, const Silhouette& silhouette,
                        const nef::Monitor& monitor);

}  // namespace nef::visual_hull
