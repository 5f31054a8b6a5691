// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nef::visual_hull {

/// The program `visual_hull masks PHOTOGRAPHS -o DIR`: masks of photographs, and a picture to look at them all. Returns
/// the exit code: 0, or 2 for bad input and usage.
int run_masks_command(int argc, char** argv);

}  // namespace nef::visual_hull
