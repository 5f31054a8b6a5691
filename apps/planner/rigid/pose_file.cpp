// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/pose_file.h"

#include <algorithm>

#include "apps/program/exact_json.h"
#include "apps/program/numbers.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

using nlohmann::json;

bool is_turned(const RigidPose& pose) {
  return pose.quaternion[1] != 0 || pose.quaternion[2] != 0 || pose.quaternion[3] != 0;
}

void require_rotation(const RigidPose& pose, const std::string& where) {
  if (pose.quaternion == Quaternion{0, 0, 0, 0}) throw InputError(where + ": the quaternion of a rotation is zero");
}

// Nothing if a line has another number of columns.
std::optional<std::vector<RigidPose>> poses_of_lines(const std::string& text, const std::string& file) {
  std::vector<RigidPose> poses;
  for (const auto& [where, v] : parse_lines(text, file)) {
    if (v.size() != 7) return std::nullopt;
    poses.push_back({{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}});
    require_rotation(poses.back(), where);
  }
  return poses;
}

std::optional<std::vector<RigidPose>> poses_of_json(const std::string& text, const std::string& file) {
  const json root = parse_exact_json(text, file);
  if (!root.contains("path") || !root["path"].is_array()) return std::nullopt;
  std::vector<RigidPose> poses;
  for (const json& entry : root["path"]) {
    if (!entry.is_object() || !entry.contains("position") || !entry.contains("quaternion")) return std::nullopt;
    const std::string where = file + ": path: pose " + std::to_string(poses.size());
    RigidPose pose;
    pose.position = point_of(entry["position"], where);
    const json& quaternion = entry["quaternion"];
    if (!quaternion.is_array() || quaternion.size() != 4) {
      throw InputError(where + ": a quaternion is a list of four numbers w, x, y, z");
    }
    for (std::size_t k = 0; k < 4; ++k) pose.quaternion[k] = rational_of(quaternion[k], where);
    require_rotation(pose, where);
    poses.push_back(std::move(pose));
  }
  return poses;
}

}  // namespace

std::optional<std::vector<RigidPose>> read_poses(const std::string& file) {
  const std::string text = read_file(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return std::nullopt;
  auto poses = text[first] == '{' ? poses_of_json(text, file) : poses_of_lines(text, file);
  if (!poses || std::none_of(poses->begin(), poses->end(), is_turned)) return std::nullopt;
  return poses;
}

}  // namespace nef::planner
