// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// An object that turns before one camera, by the same angle between images.
struct Turntable {
  int count = 0;                   ///< images of one full turn; negative if the object turns clockwise seen from above
  std::vector<double> intrinsics;  ///< f,cx,cy or fx,fy,cx,cy or the nine numbers of K
  double radius = 0;               ///< of the camera's distance from the axis
  double height = 0;               ///< of the camera above the point of the axis that it looks at
};

/// The views "1", "2", ... of a turntable: its axis is z, the camera looks at the origin, upright; in the first image
/// it stands at (radius, 0, height). Whole image coordinates are centres of pixels. Images come in the order of their
/// names. Throws InputError for values that make no camera.
Scene make_turntable(const Turntable& turntable);

/// The same of which only the number of images is known, and not even the sense of the rotation: its cameras stand for
/// those that Options::refine finds (Scene::guessed). `given` is as Turntable::count. Throws InputError for less than
/// five images or more than 100000.
Scene guess_turntable(int given);

}  // namespace nef::visual_hull
