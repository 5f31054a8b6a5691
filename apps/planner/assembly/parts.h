// SPDX-License-Identifier: Apache-2.0
//
// Parts at their assembled places.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/planner/scene/scene.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// Solids that stand together, each at its place.
struct Assembly {
  std::string name;  ///< the file's name without folders
  std::vector<std::string> names;
  std::vector<Polyhedron> parts;
  std::optional<Rational3> turning_axis;  ///< parts may turn about lines of this direction, by any angle
  bool turns_freely = false;              ///< parts may turn about all lines
  Messages messages;                      ///< what was done to the input

  /// False if parts keep their orientation.
  [[nodiscard]] bool turns() const { return turning_axis || turns_freely; }
};

/// Reads {"parts": {"name": SHAPE, ...}, "rotation": "SO(3)" or {"axis": "z" or [x, y, z]}}, SHAPE being a file
/// (relative to this one) or an expression, as in scenes (scene.h). Without "rotation" parts keep their orientation.
/// The parts are in the order of their names. Throws InputError unless each is a bounded solid.
Assembly read_assembly(const std::string& path, const MeshOptions& meshes = scene_meshes());

/// The same from text; `folder` is where file names begin.
Assembly parse_assembly(const std::string& text, const std::string& folder, const std::string& name,
                        const MeshOptions& meshes = scene_meshes());

}  // namespace nef::planner
