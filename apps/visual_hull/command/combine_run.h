// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nef::visual_hull {

/// The program `visual_hull combine SCENE SCENE... -o SCENE.json`: one scene of several series of one object. Returns
/// the exit code: 0, 1 if a series fits nowhere, or 2 for bad input and usage.
int run_combine_command(int argc, char** argv);

}  // namespace nef::visual_hull
