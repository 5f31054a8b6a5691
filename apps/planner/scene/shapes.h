// SPDX-License-Identifier: Apache-2.0
//
// Solids and surfaces for scenes, from files and expressions.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "nef/construct/construct.h"
#include "nef/forward.h"

namespace nef {
class JsonReader;
}  // namespace nef

namespace nef::planner {

/// The set in a mesh or nef file or a folder of tiles, by extension; meshes of other formats are read through assimp. A
/// mesh becomes what from_mesh makes of it by the options. If that is nothing, or if Crossings::kUnion would leave out
/// what is inside out, it becomes what it means (meaning_of), maybe a surface, with a message; with Crossings::kRefuse
/// it is an error. `mean`, if not null, receives the mean of the mesh's vertices (as assimp joins them). Throws
/// InputError.
Polyhedron read_shape_file(const std::string& path, const MeshOptions& options, Messages* messages,
                           Rational3* mean = nullptr);

/// What a string in a scene stands for: a file (relative to `folder`) or an expression of `nef eval`.
Polyhedron shape_of_text(const std::string& text, const std::string& folder, const MeshOptions& options,
                         Messages* messages);

/// What a value of a scene stands for, closed: a string as above. Errors say where it stands.
Polyhedron shape_of(const JsonReader& value, const std::string& folder, const MeshOptions& options, Messages& messages);

/// The same for what must be a bounded solid.
Polyhedron solid_of(const JsonReader& value, const std::string& folder, const MeshOptions& options, Messages& messages);

/// Fails if a file is of another kind than its reader expects, by the key that only one kind has: "robot" of a scene,
/// "parts" of an assembly, "moving" of a mechanism. The message names the option for what it is.
void require_kind(const JsonReader& root, const char* key);

/// A direction that is not zero: "x", "y", "z" or three numbers.
Rational3 direction_of(const JsonReader& value);

/// Two numbers that go up, by no more than `most` if that is given.
std::array<Rational, 2> range_of(const JsonReader& value, const std::optional<int>& most = std::nullopt);

/// A mesh file through assimp: all meshes of the scene with their transformations; faces that occur
/// twice (double-sided models) are kept once, vertices at equal places are one.
Mesh read_with_assimp(const std::string& path, Rational3* mean);

}  // namespace nef::planner
