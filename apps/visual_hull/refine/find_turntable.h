// SPDX-License-Identifier: Apache-2.0
//
// A turntable of which nothing is known but that its steps are equal: cameras from silhouettes alone.
#pragma once

#include <vector>

#include "apps/visual_hull/refine/moving_camera.h"
#include "apps/visual_hull/refine/outline.h"
#include "nef/base/monitor.h"

namespace nef::visual_hull::refine {

/// The cameras of one full turn in equal steps, as views of `outlines` in their order, to be refined further: the
/// object turns about the z axis, counterclockwise seen from above or clockwise, whichever fits; the camera stands at
/// distance 1 from a point of the axis, with square pixels and the middle of the image as its principal point. Several
/// elevations and both senses are tried with a dozen of the views. `size`: of the images. Throws InputError for less
/// than five views. Some thousand evaluations of a dozen outlines.
std::vector<MovingCamera> find_turntable(const std::vector<Outline>& outlines, const ImageSize& size,
                                         PixelOrigin origin, const nef::Monitor& monitor);

}  // namespace nef::visual_hull::refine
