// SPDX-License-Identifier: Apache-2.0
//
// Paths in files, and poses as these spell them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// The poses in a file: lines of numbers x y z, or x y z qx qy qz qw as OMPL.app and OMPL's printAsMatrix write them;
/// or the "path" of a JSON report, a list of points or of {"position": [x, y, z], "quaternion": [w, x, y, z]}. If none
/// is turned, it is a path of translations, and all quaternions are (1, 0, 0, 0). Throws InputError "file:line: what"
/// for another file, a quaternion that is zero, and a file without poses.
std::vector<RigidPose> read_path(const std::string& file);

/// A pose of such a report, exactly.
nlohmann::json pose_json(const RigidPose& pose);

/// True if the pose has a rotation.
bool is_turned(const RigidPose& pose);

}  // namespace nef::planner
