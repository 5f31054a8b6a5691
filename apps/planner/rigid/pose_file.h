// SPDX-License-Identifier: Apache-2.0
//
// Paths of rigid bodies in files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// The poses in a file: lines of seven numbers x y z qx qy qz qw, as OMPL.app and OMPL's printAsMatrix write them, or
/// JSON whose "path" is a list of {"position": [x, y, z], "quaternion": [w, x, y, z]}. Nothing if the file is of
/// another kind (three numbers a line, say) or no pose is turned: then it is a path of translations. Throws InputError
/// "file:line: what" for a quaternion that is zero.
std::optional<std::vector<RigidPose>> read_poses(const std::string& file);

}  // namespace nef::planner
