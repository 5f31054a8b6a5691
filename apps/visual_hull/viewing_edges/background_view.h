// SPDX-License-Identifier: Apache-2.0
//
// Views of objects that go on beyond the frame of their image, for the direct way.
#pragma once

#include <optional>

#include "apps/visual_hull/cones/cone.h"

namespace nef::visual_hull {

/// What a view keeps that carves only what it sees as background, as a silhouette like any other: a rectangle, within
/// which the image of `box` lies, with `background` as its hole. In the interior of the box its cone is what the view
/// keeps. Nothing if not all of the box is in front of the camera. O(n) for n vertices, and the nesting of their rings.
std::optional<Silhouette> beside_background(const Camera& camera, const Silhouette& background, const WorldBox& box,
                                            const nef::Monitor& monitor);

}  // namespace nef::visual_hull
