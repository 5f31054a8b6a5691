// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Turns space by quarter turns so that `up` ("x", "-y", ...) becomes +z: the cameras and the box. Exact. Throws
/// InputError for anything else.
void turn_up(Scene& scene, const std::string& up);

/// The camera of space moved by -shift: what it sees at X it saw at X + shift. Exact.
Camera moved(const Camera& camera, const Rational3& shift);

}  // namespace nef::visual_hull
