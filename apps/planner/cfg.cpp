// SPDX-License-Identifier: Apache-2.0
//
// OMPL.app's problem files. Not read: [benchmark] and [planner], which concern OMPL's own programs.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "apps/planner/scene.h"
#include "apps/planner/shapes.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The keys of section [problem].
class ProblemKeys {
 public:
  explicit ProblemKeys(const std::string& path) : path_(path) {
    std::ifstream in(path);
    if (!in) throw InputError(path + ": cannot be read");
    std::string line;
    std::string section;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty()) continue;
      if (line.front() == '[') {
        section = line;
        continue;
      }
      if (section != "[problem]") continue;
      const std::size_t equals = line.find('=');
      if (equals == std::string::npos) {
        throw InputError(path + ":" + std::to_string(number) + ": expected key = value, not '" + line + "'");
      }
      values_[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
    }
    if (values_.empty()) throw InputError(path + ": has no [problem] section");
  }

  [[nodiscard]] bool has(const std::string& key) const { return values_.count(key) > 0; }
  [[nodiscard]] std::string text(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw InputError(path_ + ": [problem] has no key '" + key + "'");
    return found->second;
  }
  [[nodiscard]] Rational number(const std::string& key) const {
    try {
      return parse_rational(text(key));
    } catch (const InputError& error) {
      throw InputError(path_ + ": " + key + ": " + error.what());
    }
  }
  [[nodiscard]] Rational number_or_zero(const std::string& key) const { return has(key) ? number(key) : Rational(0); }
  [[nodiscard]] Rational3 point(const std::string& prefix) const {
    return {number(prefix + ".x"), number(prefix + ".y"), number(prefix + ".z")};
  }

 private:
  std::string path_;
  std::map<std::string, std::string> values_;
};

// The rotation both states share, as a map; the identity for angle zero.
AffineMap common_rotation(const ProblemKeys& keys, const std::string& path, Messages& messages) {
  std::array<Rational, 4> start;
  std::array<Rational, 4> goal;
  for (std::size_t i = 0; i < 4; ++i) {
    static constexpr std::array<const char*, 4> kNames{".theta", ".axis.x", ".axis.y", ".axis.z"};
    start[i] = keys.number_or_zero(std::string("start") + kNames[i]);
    goal[i] = keys.number_or_zero(std::string("goal") + kNames[i]);
  }
  if (start[0] == 0 && goal[0] == 0) return AffineMap::identity();
  if (start != goal) {
    throw InputError(path +
                     ": start and goal are turned differently, and this planner only translates: "
                     "give both the same theta and axis");
  }
  if (start[1] == 0 && start[2] == 0 && start[3] == 0) throw InputError(path + ": start.axis is the zero vector");
  messages.push_back(path + ": the robot is turned once by a rational rotation within 1e-9 degrees of theta");
  const double degrees = nearest_double(start[0]) * 180 / M_PI;
  return AffineMap::rotate({start[1], start[2], start[3]}, degrees);
}

std::string beside(const std::string& path, const std::string& file) {
  return (std::filesystem::path(path).parent_path() / file).string();
}

}  // namespace

Scene read_cfg(const std::string& path) {
  const ProblemKeys keys(path);
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  Rational3 mean;
  scene.robot = closure(read_shape_file(beside(path, keys.text("robot")), &scene.messages, &mean));
  const std::string origin = keys.has("robot.origin") ? keys.text("robot.origin") : "vertex-mean";
  if (origin != "vertex-mean" && origin != "mesh") {
    throw InputError(path + ": robot.origin must be vertex-mean or mesh, not '" + origin + "'");
  }
  if (origin == "vertex-mean") {
    for (Rational& value : mean) value = -value;
    scene.robot = transform(scene.robot, AffineMap::translate(mean));
  }
  const AffineMap rotation = common_rotation(keys, path, scene.messages);
  scene.robot = transform(scene.robot, rotation);
  scene.obstacles.push_back(closure(read_shape_file(beside(path, keys.text("world")), &scene.messages)));
  scene.obstacle_names.push_back(keys.text("world"));
  scene.start = keys.point("start");
  scene.goal = keys.point("goal");
  if (keys.has("volume.min.x")) {
    scene.box = {keys.point("volume.min"), keys.point("volume.max")};
    for (std::size_t i = 0; i < 3; ++i) {
      if ((*scene.box)[0][i] > (*scene.box)[1][i]) throw InputError(path + ": volume.min is above volume.max");
    }
  }
  if (keys.has("contact")) {
    const std::string contact = keys.text("contact");
    if (contact != "allow" && contact != "forbid") {
      throw InputError(path + ": contact must be allow or forbid, not '" + contact + "'");
    }
    scene.contact = contact == "allow" ? ContactRule::kAllow : ContactRule::kForbid;
  }
  return scene;
}

}  // namespace nef::planner
