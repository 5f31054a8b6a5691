// SPDX-License-Identifier: Apache-2.0
//
// Checks the keys, reads the shapes in order (each closed, the robot moved so that its reference point is the origin),
// and then the points. Numbers are parsed from their spelling, so 0.1 is one tenth. Every error names the file and the
// key.
#include "apps/planner/scene/scene.h"

#include <filesystem>

#include "apps/planner/scene/shapes.h"
#include "apps/program/exact_json.h"
#include "nef/base/error.h"
#include "nef/base/in_quotes.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

using nlohmann::json;

// Shapes of one scene; errors say which key they come from.
class ShapeReader {
 public:
  ShapeReader(std::string folder, Messages& messages, const MeshOptions& meshes)
      : folder_(std::move(folder)), messages_(messages), meshes_(meshes) {}

  Polyhedron shape(const json& value, const std::string& what) {
    if (value.is_string()) {
      try {
        return shape_of_text(value.get<std::string>(), folder_, meshes_, &messages_);
      } catch (const InputError& error) {
        throw InputError(what + ": " + error.what());
      }
    }
    throw InputError(what + ": expected a file name or an expression in quotes, not " + in_quotes(spelled(value)));
  }

 private:
  std::string folder_;
  Messages& messages_;
  MeshOptions meshes_;
};

const std::vector<std::string> kKeys{"robot", "obstacles", "reference", "box",     "start",
                                     "goal",  "contact",   "name",      "rotation"};

void check_keys(const json& root, const std::string& name) {
  if (!root.is_object()) throw InputError(name + ": a scene is a JSON object with robot and obstacles");
  for (const auto& item : root.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), item.key()) == kKeys.end()) {
      throw InputError(name + ": unknown key '" + item.key() +
                       "' (known: robot, obstacles, reference, box, start, goal, contact, rotation)");
    }
  }
  if (root.contains("name") && !root["name"].is_string()) throw InputError(name + ": 'name' must be a string");
  for (const char* key : {"robot", "obstacles"}) {
    if (!root.contains(key)) throw InputError(name + ": '" + key + "' is missing");
  }
}

void read_obstacles(const json& list, ShapeReader& shapes, const std::string& name, Scene& scene,
                    const Monitor& monitor) {
  if (!list.is_array()) throw InputError(name + ": 'obstacles' must be a list");
  for (std::size_t i = 0; i < list.size(); ++i) {
    scene.obstacles.push_back(closure(shapes.shape(list[i], name + ": obstacle " + std::to_string(i)), monitor));
    const std::string spelled = list[i].is_string() ? list[i].get<std::string>() : std::string("a shape");
    scene.obstacle_names.push_back(spelled);
  }
}

Rational3 axis_of(const json& value, const std::string& what) {
  if (value.is_array()) {
    Rational3 axis = point_of(value, what + ": axis");
    if (axis == Rational3{}) throw InputError(what + ": axis must not be the zero vector");
    return axis;
  }
  const std::string name = value.is_string() ? value.get<std::string>() : "";
  if (name != "x" && name != "y" && name != "z") {
    throw InputError(what + R"(: axis must be "x", "y", "z" or a direction such as [1, 2, 2])");
  }
  Rational3 axis;
  axis[static_cast<std::size_t>(name[0] - 'x')] = 1;
  return axis;
}

AxisRotation rotation_of(const json& value, const std::string& what) {
  AxisRotation rotation;
  if (!value.is_object()) throw InputError(what + R"(: expected {"axis": "z", "range": [0, 360]})");
  for (const auto& item : value.items()) {
    if (item.key() != "axis" && item.key() != "range") throw InputError(what + ": unknown key '" + item.key() + "'");
  }
  if (value.contains("axis")) {
    rotation.axis = axis_of(value["axis"], what);
  }
  if (value.contains("range")) {
    const json& range = value["range"];
    if (!range.is_array() || range.size() != 2) throw InputError(what + ": range must be two angles in degrees");
    rotation.low = rational_of(range[0], what + ": range");
    rotation.high = rational_of(range[1], what + ": range");
    constexpr int kMostDegrees = 36000;  // a hundred turns: each of them has cells of its own
    if (rotation.low >= rotation.high || rotation.high - rotation.low > kMostDegrees) {
      throw InputError(what + ": range must go up, by no more than " + std::to_string(kMostDegrees) + " degrees");
    }
  }
  return rotation;
}

// Start or goal; `angle`, if wanted, receives the fourth number.
Rational3 end_of(const json& value, Rational* angle, const std::string& what) {
  if (angle == nullptr || !value.is_array() || value.size() != 4) return point_of(value, what);
  *angle = rational_of(value[3], what);
  return point_of(json::array({value[0], value[1], value[2]}), what);
}

}  // namespace

void require_no_rotation(const Scene& scene) {
  if (!scene.rotation) return;
  throw InputError(scene.name +
                   ": the robot turns (rotation), and this is about translations only: ask for a path, or leave the "
                   "rotation out");
}

Scene parse_scene(const std::string& text, const std::string& folder, const std::string& name,
                  const MeshOptions& meshes) {
  const Monitor& monitor = meshes.monitor;
  const json root = parse_exact_json(text, name);
  check_keys(root, name);
  Scene scene;
  scene.name = std::filesystem::path(name).stem().string();
  ShapeReader shapes(folder, scene.messages, meshes);
  scene.robot = closure(shapes.shape(root["robot"], name + ": robot"), monitor);
  if (scene.robot.is_empty()) throw InputError(name + ": the robot is empty");
  if (!scene.robot.is_bounded()) throw InputError(name + ": the robot must be bounded");
  if (root.contains("reference")) {
    Rational3 reference = point_of(root["reference"], name + ": reference");
    for (Rational& value : reference) value = -value;
    scene.robot = transform(scene.robot, AffineMap::translate(reference), monitor);
  }
  read_obstacles(root["obstacles"], shapes, name, scene, monitor);
  if (root.contains("box") && !root["box"].is_null()) {
    const json& box = root["box"];
    if (!box.is_array() || box.size() != 2) throw InputError(name + ": 'box' must be [low point, high point]");
    scene.box = {point_of(box[0], name + ": box"), point_of(box[1], name + ": box")};
    for (std::size_t i = 0; i < 3; ++i) {
      if ((*scene.box)[0][i] > (*scene.box)[1][i])
        throw InputError(name + ": box: its first point must be the lower one");
    }
  }
  if (root.contains("rotation")) scene.rotation = rotation_of(root["rotation"], name + ": rotation");
  Rational* start_angle = scene.rotation ? &scene.rotation->start : nullptr;
  Rational* goal_angle = scene.rotation ? &scene.rotation->goal : nullptr;
  if (root.contains("start")) scene.start = end_of(root["start"], start_angle, name + ": start");
  if (root.contains("goal")) scene.goal = end_of(root["goal"], goal_angle, name + ": goal");
  if (root.contains("contact")) {
    const json& contact = root["contact"];
    if (contact != "allow" && contact != "forbid") {
      throw InputError(name + R"(: 'contact' must be "allow" or "forbid", not )" + in_quotes(spelled(contact)));
    }
    scene.contact = contact == "allow" ? ContactRule::kAllow : ContactRule::kForbid;
  }
  return scene;
}

Scene read_scene(const std::string& path, const MeshOptions& meshes) {
  if (lower_extension(path) == "cfg") return read_cfg(path, meshes);
  return parse_scene(read_file(path), std::filesystem::path(path).parent_path().string(), path, meshes);
}

}  // namespace nef::planner
