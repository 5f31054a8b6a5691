// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/assembly/parts.h"

#include <filesystem>

#include "apps/planner/scene/shapes.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

void read_turns(const JsonReader& value, Assembly& assembly) {
  if (value.value().is_object()) {
    value.require_keys({"axis"});
    assembly.turning_axis = direction_of(value["axis"]);
    return;
  }
  if (value.value() != "SO(3)") {
    value.fail(R"J(must be "SO(3)", for turns about all axes, or about one axis, as in {"axis": "z"})J");
  }
  assembly.turns_freely = true;
}

}  // namespace

Assembly parse_assembly(const std::string& text, const std::string& folder, const std::string& name,
                        const MeshOptions& meshes) {
  const nlohmann::json value = parse_exact_json(text, name);
  const JsonReader root(value, name);
  require_kind(root, "parts");
  root.require_keys({"parts"}, {"rotation"});
  if (!value["parts"].is_object()) root.fail(R"(an assembly is {"parts": {"name": file or expression, ...}})");
  Assembly assembly;
  assembly.name = std::filesystem::path(name).stem().string();
  for (const auto& item : value["parts"].items()) {
    const JsonReader part(item.value(), name + ": part '" + item.key() + "'");
    assembly.parts.push_back(solid_of(part, folder, meshes, assembly.messages));
    assembly.names.push_back(item.key());
  }
  if (root.has("rotation")) read_turns(root["rotation"], assembly);
  if (assembly.parts.empty()) throw InputError(name + ": the assembly has no parts");
  return assembly;
}

Assembly read_assembly(const std::string& path, const MeshOptions& meshes) {
  return parse_assembly(read_file(path), std::filesystem::path(path).parent_path().string(), path, meshes);
}

}  // namespace nef::planner
