// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nef::visual_hull {

/// The program `visual_hull`: does what the command line says; errors go to stderr as one line. The exit code: 0, or 1
/// if the hull is empty or flat, or --verify failed, or 2 for bad input or usage, or if --check finds that an image is
/// missing.
int run_command(int argc, char** argv);

}  // namespace nef::visual_hull
