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

constexpr std::array kTypes{"hinge", "slider", "screw", "four-bar"};  // in the order of Joint::Kind

Joint four_bar_of(const JsonReader& value) {
  constexpr std::array kLinks{"coupler", "rocker"};  // in the order of FourBar::Link
  const auto link = static_cast<FourBar::Link>(value["moves"].word(kLinks));
  return Joint::four_bar(direction_of(value["axis"]), value["pivots"].exactly<2>(JsonReader::point_of),
                         value["pins"].exactly<2>(JsonReader::point_of), link);
}

Joint joint_of(const JsonReader& value, Joint::Kind kind) {
  const auto point = [&] { return value.has("point") ? value["point"].point() : Rational3{}; };
  switch (kind) {
    case Joint::Kind::kHinge:
      value.require_keys({"type", "axis"}, {"point", "range"});
      return Joint::hinge(direction_of(value["axis"]), point());
    case Joint::Kind::kSlider:
      value.require_keys({"type", "direction", "range"});
      return Joint::slider(direction_of(value["direction"]));
    case Joint::Kind::kScrew:
      value.require_keys({"type", "axis", "range", "pitch"}, {"point"});
      return Joint::screw(direction_of(value["axis"]), point(), value["pitch"].number());
    default:
      value.require_keys({"type", "axis", "pivots", "pins", "moves", "range"});
      return four_bar_of(value);
  }
}

void read_joint(const JsonReader& value, Mechanism& m) {
  if (!value.has("type")) value.fail(R"(expected an object with a "type")");
  const auto kind = static_cast<Joint::Kind>(value["type"].word(kTypes));
  m.joint = joint_of(value, kind);
  std::array<Rational, 2> range{0, 360};
  constexpr int kMostDegrees = 3600;
  if (value.has("range")) {
    range = kind == Joint::Kind::kSlider ? range_of(value["range"]) : range_of(value["range"], kMostDegrees);
  }
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
  require_kind(root, "moving");
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
