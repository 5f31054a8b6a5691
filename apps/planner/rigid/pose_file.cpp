// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/pose_file.h"

#include <algorithm>

#include "apps/program/numbers.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

RigidPose checked(RigidPose pose, const std::string& where) {
  if (pose.quaternion == Quaternion{0, 0, 0, 0}) throw InputError(where + ": the quaternion of a rotation is zero");
  return pose;
}

std::vector<RigidPose> poses_of_lines(const std::string& text, const std::string& file) {
  std::vector<RigidPose> poses;
  for (const auto& [where, v] : parse_lines(text, file)) {
    if (v.size() != 3 && v.size() != 7) {
      throw InputError(where + ": expected x y z, or x y z qx qy qz qw, not " + std::to_string(v.size()) + " numbers");
    }
    RigidPose& pose = poses.emplace_back(RigidPose{{v[0], v[1], v[2]}});
    if (v.size() == 7) pose.quaternion = {v[6], v[3], v[4], v[5]};
    checked(pose, where);
  }
  return poses;
}

std::vector<RigidPose> poses_of_json(const std::string& text, const std::string& file) {
  const nlohmann::json value = parse_exact_json(text, file);
  const JsonReader root(value, file);
  if (!root.has("path") || !value["path"].is_array()) root.fail("has no list 'path'");
  return root["path"].list([](const JsonReader& pose) {
    if (!pose.has("position") || !pose.has("quaternion")) return RigidPose{pose.point()};
    return checked({pose["position"].point(), pose["quaternion"].exactly<4>(&JsonReader::number_of)}, pose.where());
  });
}

}  // namespace

nlohmann::json pose_json(const RigidPose& pose) {
  return {{"position", exact_json(pose.position)}, {"quaternion", exact_json(pose.quaternion)}};
}

bool is_turned(const RigidPose& pose) {
  return pose.quaternion[1] != 0 || pose.quaternion[2] != 0 || pose.quaternion[3] != 0;
}

std::vector<RigidPose> read_path(const std::string& file) {
  const std::string text = read_file(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (text.rfind("t,", 0) == 0) {
    throw InputError(file + ": this is a table with times; name the .json or .txt file of the path instead");
  }
  const bool is_json = first != std::string::npos && text[first] == '{';
  std::vector<RigidPose> poses = is_json ? poses_of_json(text, file) : poses_of_lines(text, file);
  if (poses.empty()) throw InputError(file + ": contains no way-points");
  if (std::none_of(poses.begin(), poses.end(), is_turned)) {
    for (RigidPose& pose : poses) pose.quaternion = {1, 0, 0, 0};
  }
  return poses;
}

}  // namespace nef::planner
