// SPDX-License-Identifier: Apache-2.0
//
// OMPL.app's problem files: lines `key = value` of section [problem], all others ignored ([benchmark] and [planner]
// concern OMPL's own programs). The rotations of start and goal decide what the scene is: equal ones are applied to the
// robot once, different ones about one axis make a robot that turns. Of others only paths are certified.
#include "apps/planner/scene/cfg.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "apps/planner/scene/shapes.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"

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
  ProblemKeys(std::string text, const std::string& path) : path_(path) {
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // a byte order mark
    std::istringstream in(text);
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
        throw InputError(path + ":" + std::to_string(number) + ": expected key = value, not " + in_quotes(line));
      }
      values_[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
    }
    if (values_.empty()) throw InputError(path + ": has no [problem] section");
  }

  [[nodiscard]] bool has(const std::string& key) const { return values_.count(key) > 0; }
  /// True if a key begins like this.
  [[nodiscard]] bool has_any(const std::string& prefix) const {
    const auto next = values_.lower_bound(prefix);
    return next != values_.end() && next->first.compare(0, prefix.size(), prefix) == 0;
  }
  [[nodiscard]] std::string text(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw InputError(path_ + ": [problem] has no key '" + key + "'");
    return found->second;
  }
  [[nodiscard]] Rational number(const std::string& key) const {
    const std::string spelled = text(key);
    try {
      return parse_rational(spelled);
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

/// A rotation as .cfg files give it: an angle about an axis of any length.
struct Rotation {
  Rational theta;  ///< in radians
  Rational3 axis;
};

Rotation rotation_of(const ProblemKeys& keys, const std::string& state) {
  return {keys.number_or_zero(state + ".theta"),
          {keys.number_or_zero(state + ".axis.x"), keys.number_or_zero(state + ".axis.y"),
           keys.number_or_zero(state + ".axis.z")}};
}

bool is_parallel(const Rational3& a, const Rational3& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (a[i] * b[j] != a[j] * b[i]) return false;
  }
  return true;
}

// How both states are turned. Angles are compared as numbers, not modulo 2 pi, which is irrational.
struct TwoRotations {
  Rotation start;
  Rotation goal;

  // About one axis, if there is one, which points the way of the start's unless that does not turn.
  [[nodiscard]] bool one_axis() const {
    return start.theta == 0 || goal.theta == 0 || is_parallel(start.axis, goal.axis);
  }
  [[nodiscard]] const Rational3& axis() const { return start.theta != 0 || goal.theta == 0 ? start.axis : goal.axis; }
  [[nodiscard]] Rational goal_theta() const {
    Rational along;
    for (std::size_t i = 0; i < 3; ++i) along += axis()[i] * goal.axis[i];
    return along < 0 ? Rational(-goal.theta) : goal.theta;
  }
};

TwoRotations rotations_of(const ProblemKeys& keys, const std::string& path) {
  TwoRotations result{rotation_of(keys, "start"), rotation_of(keys, "goal")};
  for (const auto& [state, rotation] : {std::pair("start", &result.start), std::pair("goal", &result.goal)}) {
    if (rotation->theta != 0 && rotation->axis == Rational3{}) {
      throw InputError(path + ": " + state + ".axis is the zero vector or missing");
    }
  }
  return result;
}

// Of doubles, as OMPL.app computes it.
std::array<Rational, 4> quaternion_of(const Rotation& rotation) {
  if (rotation.theta == 0) return {1, 0, 0, 0};
  const std::array<double, 3> axis{nearest_double(rotation.axis[0]), nearest_double(rotation.axis[1]),
                                   nearest_double(rotation.axis[2])};
  const double half = nearest_double(rotation.theta) / 2;
  const double sine = std::sin(half) / std::hypot(axis[0], axis[1], axis[2]);
  return {exact_rational(std::cos(half)), exact_rational(sine * axis[0]), exact_rational(sine * axis[1]),
          exact_rational(sine * axis[2])};
}

Rational degrees_of(const Rational& radians) { return exact_rational(nearest_double(radians) * 180 / M_PI); }

// A rotation that both states share is applied to the robot once; else the scene is one of a robot that turns.
void apply_rotations(const TwoRotations& rotations, CfgRotations allowed, const std::string& path, Scene& scene,
                     const Monitor& monitor) {
  scene.quaternions = {quaternion_of(rotations.start), quaternion_of(rotations.goal)};
  if (allowed == CfgRotations::kAll || !rotations.one_axis()) {
    scene.turns_freely = true;
    return;
  }
  const Rational& start = rotations.start.theta;
  const Rational goal = rotations.goal_theta();
  if (start != goal) {
    scene.rotation.emplace();
    scene.rotation->axis = rotations.axis();
    scene.rotation->start = degrees_of(start);
    scene.rotation->goal = degrees_of(goal);
    scene.messages.push_back(path +
                             ": the robot turns about one axis only, by rational rotations within 1e-9 degrees "
                             "of theta at start and goal");
  } else if (start != 0) {
    scene.messages.push_back(path + ": the robot is turned once by a rational rotation within 1e-9 degrees of theta");
    scene.robot_rotation = AffineMap::rotate(rotations.axis(), nearest_double(degrees_of(start)));
    scene.robot = transform(scene.robot, scene.robot_rotation, monitor);
  }
}

std::string beside(const std::string& path, const std::string& file) {
  return (std::filesystem::path(path).parent_path() / file).string();
}

}  // namespace

Scene read_cfg(const std::string& path, const MeshOptions& meshes, CfgRotations rotations) {
  return parse_cfg(read_file(path), path, meshes, rotations);
}

Scene freely_turning_scene(const std::string& path, const MeshOptions& meshes) {
  if (lower_extension(path) != "cfg") {
    throw InputError(path +
                     ": only the robots of .cfg files are made to turn freely; in a scene (.json) write "
                     "\"rotation\": \"SO(3)\"");
  }
  return read_cfg(path, meshes, CfgRotations::kAll);
}

std::vector<std::string> files_of_cfg(const std::string& text, const std::string& path) {
  const ProblemKeys keys(text, path);
  std::vector<std::string> files;
  for (const char* key : {"robot", "world"}) {
    if (keys.has(key)) files.push_back(keys.text(key));
  }
  return files;
}

Scene parse_cfg(const std::string& text, const std::string& path, const MeshOptions& meshes, CfgRotations rotations) {
  const Monitor& monitor = meshes.monitor;
  const ProblemKeys keys(text, path);
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  Rational3 mean;
  scene.robot = closure(read_shape_file(beside(path, keys.text("robot")), meshes, &scene.messages, &mean), monitor);
  const std::string origin = keys.has("robot.origin") ? keys.text("robot.origin") : "vertex-mean";
  if (origin != "vertex-mean" && origin != "mesh") {
    throw InputError(path + ": robot.origin must be vertex-mean or mesh, not " + in_quotes(origin));
  }
  if (origin == "vertex-mean") {
    for (Rational& value : mean) value = -value;
    scene.robot = transform(scene.robot, AffineMap::translate(mean), monitor);
  }
  apply_rotations(rotations_of(keys, path), rotations, path, scene, monitor);
  scene.obstacles.push_back(
      closure(read_shape_file(beside(path, keys.text("world")), meshes, &scene.messages), monitor));
  scene.obstacle_names.push_back(keys.text("world"));
  scene.start = keys.point("start");
  scene.goal = keys.point("goal");
  if (!scene.turns_freely) {  // else whoever asks for a path is refused, and told why
    const char* motions = scene.rotation ? ": paths are searched for a robot that translates and turns about one axis"
                                         : ": paths are searched for a robot that translates and keeps its orientation";
    scene.messages.push_back(path + motions +
                             "; OMPL.app's robots turn freely (--turn-freely, turn_freely=True in Python)");
  }
  if (keys.has_any("volume.")) {
    scene.box = {keys.point("volume.min"), keys.point("volume.max")};
    for (std::size_t i = 0; i < 3; ++i) {
      if ((*scene.box)[0][i] > (*scene.box)[1][i]) throw InputError(path + ": volume.min is above volume.max");
    }
  }
  if (keys.has("contact")) {
    const std::string contact = keys.text("contact");
    if (contact != "allow" && contact != "forbid") {
      throw InputError(path + ": contact must be allow or forbid, not " + in_quotes(contact));
    }
    scene.contact = contact == "allow" ? ContactRule::kAllow : ContactRule::kForbid;
  }
  return scene;
}

}  // namespace nef::planner
