// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/assembly/parts.h"

#include <filesystem>

#include "apps/planner/scene/shapes.h"
#include "apps/program/exact_json.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {

Assembly parse_assembly(const std::string& text, const std::string& folder, const std::string& name,
                        const MeshOptions& meshes) {
  const nlohmann::json root = parse_exact_json(text, name);
  if (!root.is_object() || !root.contains("parts") || !root["parts"].is_object()) {
    throw InputError(name + R"(: an assembly is {"parts": {"name": file or expression, ...}})");
  }
  for (const auto& item : root.items()) {
    if (item.key() != "parts") throw InputError(name + ": unknown key '" + item.key() + "' (known: parts)");
  }
  Assembly assembly;
  assembly.name = std::filesystem::path(name).stem().string();
  for (const auto& item : root["parts"].items()) {
    const std::string what = name + ": part '" + item.key() + "'";
    if (!item.value().is_string()) throw InputError(what + ": expected a file name or an expression in quotes");
    Polyhedron part;
    try {
      part =
          closure(shape_of_text(item.value().get<std::string>(), folder, meshes, &assembly.messages), meshes.monitor);
    } catch (const InputError& error) {
      throw InputError(what + ": " + error.what());
    }
    if (part.is_empty() || !part.is_bounded() || !part.is_regular()) {
      throw InputError(what + ": a part must be a bounded solid without surfaces, curves or points sticking out");
    }
    assembly.names.push_back(item.key());
    assembly.parts.push_back(std::move(part));
  }
  if (assembly.parts.empty()) throw InputError(name + ": the assembly has no parts");
  return assembly;
}

Assembly read_assembly(const std::string& path, const MeshOptions& meshes) {
  return parse_assembly(read_file(path), std::filesystem::path(path).parent_path().string(), path, meshes);
}

}  // namespace nef::planner
