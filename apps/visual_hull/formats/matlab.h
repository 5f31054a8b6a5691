// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// True if the bytes begin as a MATLAB file of version 5 does.
bool is_matlab_file(const std::string& bytes);

/// Reads projection matrices from a MATLAB file of version 5 (by libmatio): a cell array of 3x4 matrices, an array of
/// 3x4xN, or N variables that are 3x4 matrices each. `variable` names it where several fit (with a `*`: all 3x4
/// variables of such names). Views are numbered from 1; whole image coordinates are centres of pixels. libmatio parses
/// under limits (foreign_parser.h). Throws InputError.
Scene read_matlab(const std::filesystem::path& file, const std::string& variable);

}  // namespace nef::visual_hull
