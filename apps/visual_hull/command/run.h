// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/command/arguments.h"

namespace visual_hull {

/// Does what the command line says; the exit code: 0, or 1 if the hull is empty or flat, or --verify failed, or 2 if
/// --check finds that an image is missing. Throws nef::InputError.
int run(const Arguments& arguments);

}  // namespace visual_hull
