// SPDX-License-Identifier: Apache-2.0
//
// Paths as text: lines of numbers, OMPL's matrix, and both read back.
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

/// Way-points from a file: the "path" of a JSON report (exact), or lines of three numbers or of the seven of an SE(3)
/// matrix. Throws InputError "file:line: what".
std::vector<Rational3> read_waypoints(const std::string& file);

}  // namespace nef::planner
