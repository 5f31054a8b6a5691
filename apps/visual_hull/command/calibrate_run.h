// SPDX-License-Identifier: Apache-2.0
//
// visual_hull board, which makes a board to be printed, and visual_hull calibrate, which finds cameras by it.
#pragma once

namespace nef::visual_hull {

/// One run of the program; argv[1] and what follows are the words behind `board`. Returns the exit code.
int run_board_command(int argc, char** argv);

/// The same for `calibrate`.
int run_calibrate_command(int argc, char** argv);

}  // namespace nef::visual_hull
