// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "apps/planner/mechanism/joint.h"
#include "apps/planner/scene/shapes.h"
#include "apps/program/exact_json.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

using nlohmann::json;

void check_mechanism_keys(const json& object, const std::vector<std::string>& known, const std::string& what) {
  if (!object.is_object()) throw InputError(what + ": expected a JSON object");
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    throw InputError(what + ": unknown key '" + item.key() + "' (known: " + names + ")");
  }
}

Rational3 direction_of_json(const json& value, const std::string& what) {
  if (value.is_string()) {
    const std::string name = value.get<std::string>();
    if (name == "x" || name == "y" || name == "z") {
      Rational3 axis;
      axis[static_cast<std::size_t>(name[0] - 'x')] = 1;
      return axis;
    }
  }
  if (!value.is_array()) throw InputError(what + R"(: expected "x", "y", "z" or a direction such as [1, 2, 2])");
  Rational3 direction = point_of(value, what);
  if (direction == Rational3{}) throw InputError(what + ": must not be the zero vector");
  return direction;
}

void read_joint(const json& value, const std::string& name, Mechanism& m) {
  const std::string what = name + ": joint";
  const std::string type = value.is_object() && value.contains("type") && value["type"].is_string()
                               ? value["type"].get<std::string>()
                               : std::string();
  if (type != "hinge" && type != "slider" && type != "screw") {
    throw InputError(what + R"(: "type" must be "hinge", "slider" or "screw")");
  }
  const bool slides = type == "slider";
  std::vector<std::string> known{"type", "range"};
  if (slides) known.emplace_back("direction");
  if (!slides) known.insert(known.end(), {"axis", "point"});
  if (type == "screw") known.emplace_back("pitch");
  check_mechanism_keys(value, known, what);
  const std::string along = slides ? "direction" : "axis";
  if (!value.contains(along)) throw InputError(what + ": '" + along + "' is missing");
  const Rational3 direction = direction_of_json(value[along], what + ": " + along);
  const Rational3 point = value.contains("point") ? point_of(value["point"], what + ": point") : Rational3{};
  if (slides) {
    m.joint = Joint::slider(direction);
  } else if (type == "hinge") {
    m.joint = Joint::hinge(direction, point);
  } else {
    if (!value.contains("pitch")) throw InputError(what + ": 'pitch' is missing");
    m.joint = Joint::screw(direction, point, rational_of(value["pitch"], what + ": pitch"));
  }
  Rational low = 0;
  Rational high = 360;
  if (value.contains("range")) {
    const json& range = value["range"];
    if (!range.is_array() || range.size() != 2) throw InputError(what + ": range must be two numbers");
    low = rational_of(range[0], what + ": range");
    high = rational_of(range[1], what + ": range");
  } else if (type != "hinge") {
    throw InputError(what + ": 'range' is missing");
  }
  constexpr int kMostDegrees = 3600;
  if (low >= high || (!slides && high - low > kMostDegrees)) {
    throw InputError(what + ": range must go up" + (slides ? "" : ", by no more than 3600 degrees"));
  }
  m.low = m.joint.value_of(low);
  m.high = m.joint.value_of(high);
}

Polyhedron solid_of(const json& value, const std::string& folder, const std::string& what, const MeshOptions& meshes,
                    Messages& messages) {
  if (!value.is_string()) throw InputError(what + ": expected a file name or an expression in quotes");
  Polyhedron set;
  try {
    set = closure(shape_of_text(value.get<std::string>(), folder, meshes, &messages), meshes.monitor);
  } catch (const InputError& error) {
    throw InputError(what + ": " + error.what());
  }
  if (set.is_empty() || !set.is_bounded() || !set.is_regular()) {
    throw InputError(what + ": must be a bounded solid without surfaces, curves or points sticking out");
  }
  return set;
}

}  // namespace

Mechanism parse_mechanism(const std::string& text, const std::string& folder, const std::string& name,
                          const MeshOptions& meshes) {
  const json root = parse_exact_json(text, name);
  check_mechanism_keys(root, {"moving", "fixed", "joint"}, name);
  for (const char* key : {"moving", "fixed", "joint"}) {
    if (!root.contains(key)) throw InputError(name + ": '" + key + "' is missing");
  }
  if (!root["fixed"].is_array()) throw InputError(name + ": 'fixed' must be a list");
  Mechanism m;
  m.name = std::filesystem::path(name).stem().string();
  read_joint(root["joint"], name, m);
  m.moving = solid_of(root["moving"], folder, name + ": moving", meshes, m.messages);
  for (std::size_t i = 0; i < root["fixed"].size(); ++i) {
    const json& value = root["fixed"][i];
    m.fixed.push_back(solid_of(value, folder, name + ": fixed " + std::to_string(i), meshes, m.messages));
    m.fixed_names.push_back(value.get<std::string>());
  }
  return m;
}

Mechanism read_mechanism(const std::string& path, const MeshOptions& meshes) {
  return parse_mechanism(read_file(path), std::filesystem::path(path).parent_path().string(), path, meshes);
}

}  // namespace nef::planner
