// SPDX-License-Identifier: Apache-2.0
//
// Checks the keys, reads the shapes in order (each closed, the robot moved so that its reference point is the origin),
// and then the points. Numbers are parsed from their spelling, so 0.1 is one tenth. Every error names the file and the
// key.
#include "apps/planner/scene/scene.h"

#include <array>
#include <filesystem>

#include "apps/planner/scene/shapes.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"

namespace nef::planner {
namespace {

constexpr const char* kFreeRotation = "SO(3)";

void read_rotation(const JsonReader& value, Scene& scene) {
  if (value.value().is_string()) {
    if (value.value() != kFreeRotation) {
      value.fail(
          R"J(must be "SO(3)", for all rotations, or a range about one axis, as in {"axis": "z", "range": [0, 90]})J");
    }
    scene.turns_freely = true;
    scene.quaternions = {{{1, 0, 0, 0}, {1, 0, 0, 0}}};
    return;
  }
  value.require_keys({}, {"axis", "range"});
  AxisRotation& rotation = scene.rotation.emplace();
  if (value.has("axis")) rotation.axis = direction_of(value["axis"]);
  constexpr int kMostDegrees = 36000;  // a hundred turns: each of them has cells of its own
  if (!value.has("range")) return;
  const std::array<Rational, 2> range = range_of(value["range"], kMostDegrees);
  rotation.low = range[0];
  rotation.high = range[1];
}

// Start or goal of a robot that turns freely; `quaternion` receives its rotation.
Rational3 pose_end_of(const JsonReader& value, std::array<Rational, 4>& quaternion) {
  if (!value.value().is_object()) {
    value.fail(R"(expected {"position": [x, y, z], "quaternion": [w, x, y, z]}, since the robot turns freely)");
  }
  value.require_keys({"position", "quaternion"});
  quaternion = value["quaternion"].exactly<4>(&JsonReader::number_of);
  if (quaternion == std::array<Rational, 4>{}) value["quaternion"].fail("a rotation's quaternion must not be zero");
  return value["position"].point();
}

// Start or goal; `angle`, if wanted, receives the fourth number.
Rational3 end_of(const JsonReader& value, Rational* angle) {
  if (value.value().is_object()) value.fail(R"J(a pose with a quaternion needs "rotation": "SO(3)" in the scene)J");
  if (!value.value().is_array() || value.value().size() != 4) return value.point();
  if (angle == nullptr) value.fail("expected three numbers; a fourth one, degrees, needs a 'rotation' in the scene");
  const std::array<Rational, 4> numbers = value.exactly<4>(&JsonReader::number_of);
  *angle = numbers[3];
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

void require_bounded_robot(const Scene& scene) {
  if (!scene.robot.is_bounded()) throw InputError("the robot is unbounded: a robot must be a bounded set");
}

void require_no_rotation(const Scene& scene) {
  if (scene.turns_freely) {
    throw InputError(
        scene.name +
        ": the robot turns freely (\"rotation\" is \"SO(3)\", or start and goal are turned about different "
        "axes), but this works for translations only; plan a path, or certify one (--path)");
  }
  if (!scene.rotation) return;
  throw InputError(scene.name +
                   ": the robot turns, but this works for translations only; plan a path, or remove 'rotation' from "
                   "the scene");
}

Scene parse_scene(const std::string& text, const std::string& folder, const std::string& name,
                  const MeshOptions& meshes) {
  const Monitor& monitor = meshes.monitor;
  const nlohmann::json value = parse_exact_json(text, name);
  const JsonReader root(value, name);
  require_kind(root, "robot");
  root.require_keys({"robot", "obstacles"}, {"reference", "box", "start", "goal", "contact", "rotation", "name"});
  if (root.has("name") && !value["name"].is_string()) root.fail("'name' must be a string");
  Scene scene;
  scene.name = std::filesystem::path(name).stem().string();
  scene.robot = shape_of(root["robot"], folder, meshes, scene.messages);
  if (scene.robot.is_empty()) root.fail("the robot is empty");
  if (!scene.robot.is_bounded()) root.fail("the robot must be bounded");
  if (root.has("reference")) {
    Rational3 reference = root["reference"].point();
    for (Rational& x : reference) x = -x;
    scene.robot = transform(scene.robot, AffineMap::translate(reference), monitor);
  }
  if (!value["obstacles"].is_array()) root.fail(R"('obstacles' must be a list, as in ["wall.off"])");
  for (const nlohmann::json& obstacle : value["obstacles"]) {
    const JsonReader at(obstacle, name + ": obstacle " + std::to_string(scene.obstacles.size()));
    scene.obstacles.push_back(shape_of(at, folder, meshes, scene.messages));
    scene.obstacle_names.push_back(obstacle.get<std::string>());
  }
  if (root.has("box") && !value["box"].is_null()) {
    if (!value["box"].is_array() || value["box"].size() != 2)
      root.fail("'box' must be [low point, high point], as in [[0, 0, 0], [9, 3, 3]]");
    scene.box = root["box"].exactly<2>(&JsonReader::point_of);
    for (std::size_t i = 0; i < 3; ++i) {
      if ((*scene.box)[0][i] > (*scene.box)[1][i]) root["box"].fail("its first point must be the lower one");
    }
  }
  if (root.has("rotation")) read_rotation(root["rotation"], scene);
  const auto read_end = [&](const char* key, std::optional<Rational3>& position, Rational* angle, std::size_t end) {
    if (!root.has(key)) return;
    position = scene.turns_freely ? pose_end_of(root[key], (*scene.quaternions)[end]) : end_of(root[key], angle);
  };
  read_end("start", scene.start, scene.rotation ? &scene.rotation->start : nullptr, 0);
  read_end("goal", scene.goal, scene.rotation ? &scene.rotation->goal : nullptr, 1);
  if (root.has("contact")) {
    scene.contact = static_cast<ContactRule>(root["contact"].word(std::array{"allow", "forbid"}));
  }
  return scene;
}

Scene read_scene(const std::string& path, const MeshOptions& meshes) {
  const std::string extension = lower_extension(path);
  if (extension == "cfg") return read_cfg(path, meshes);
  const std::string text = read_file(path);
  if (is_file_extension(extension)) {
    throw InputError(path + ": a set, not a scene; a scene is a .json file that names a robot and obstacles");
  }
  return parse_scene(text, std::filesystem::path(path).parent_path().string(), path, meshes);
}

}  // namespace nef::planner
