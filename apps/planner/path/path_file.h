// SPDX-License-Identifier: Apache-2.0
//
// Paths as text: lines of numbers and OMPL's matrix; rigid/pose_file.h reads them.
#pragma once

#include <string>
#include <vector>

#include "apps/planner/path/path.h"

namespace nef::planner {

/// One way-point a line, three doubles with 17 digits.
std::string path_text(const ExactPath& path);
/// What PathGeometric::printAsMatrix prints, with 17 digits: a row per way-point, a blank at the end
/// of each and a blank line after the last. With `se3`, seven columns x y z qx qy qz qw as OMPL.app reads.
std::string path_matrix(const ExactPath& path, bool se3);

}  // namespace nef::planner
