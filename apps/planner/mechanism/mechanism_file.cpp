// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>

#include "apps/planner/mechanism/joint.h"
#include "apps/planner/scene/shapes.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

void read_joint(const JsonReader& value, Mechanism& m) {
  if (!value.has("type")) value.fail(R"(expected an object with a "type")");
  const std::size_t type = value["type"].word(std::array{"hinge", "slider", "screw"});
  const bool turns = type != 1;
  const char* along = turns ? "axis" : "direction";
  std::vector<const char*> required{"type", along};
  std::vector<const char*> optional;
  if (turns) optional.emplace_back("point");
  (type == 0 ? optional : required).emplace_back("range");
  if (type == 2) required.emplace_back("pitch");
  value.require_keys(required, optional);
  const Rational3 direction = direction_of(value[along]);
  const Rational3 point = value.has("point") ? value["point"].point() : Rational3{};
  m.joint = type == 0   ? Joint::hinge(direction, point)
            : type == 1 ? Joint::slider(direction)
                        : Joint::screw(direction, point, value["pitch"].number());
  std::array<Rational, 2> range{0, 360};
  constexpr int kMostDegrees = 3600;
  if (value.has("range")) range = turns ? range_of(value["range"], kMostDegrees) : range_of(value["range"]);
  m.low = m.joint.value_of(range[0]);
  m.high = m.joint.value_of(range[1]);
}

}  // namespace

Assembly assembly_of(const Mechanism& mechanism) {
  Assembly assembly;
  assembly.name = mechanism.name;
  assembly.names.emplace_back("moving");
  assembly.parts.push_back(mechanism.moving);
  assembly.names.insert(assembly.names.end(), mechanism.fixed_names.begin(), mechanism.fixed_names.end());
  assembly.parts.insert(assembly.parts.end(), mechanism.fixed.begin(), mechanism.fixed.end());
  assembly.messages = mechanism.messages;
  return assembly;
}

Mechanism parse_mechanism(const std::string& text, const std::string& folder, const std::string& name,
                          const MeshOptions& meshes) {
  const nlohmann::json value = parse_exact_json(text, name);
  const JsonReader root(value, name);
  root.require_keys({"moving", "fixed", "joint"});
  if (!value["fixed"].is_array()) root.fail(R"('fixed' must be a list, as in ["wall.off"])");
  Mechanism m;
  m.name = std::filesystem::path(name).stem().string();
  read_joint(root["joint"], m);
  m.moving = solid_of(root["moving"], folder, meshes, m.messages);
  for (const nlohmann::json& fixed : value["fixed"]) {
    const JsonReader at(fixed, name + ": fixed " + std::to_string(m.fixed.size()));
    m.fixed.push_back(solid_of(at, folder, meshes, m.messages));
    m.fixed_names.push_back(fixed.get<std::string>());
  }
  return m;
}

Mechanism read_mechanism(const std::string& path, const MeshOptions& meshes) {
  return parse_mechanism(read_file(path), std::filesystem::path(path).parent_path().string(), path, meshes);
}

}  // namespace nef::planner
