// SPDX-License-Identifier: Apache-2.0
//
// Solids and surfaces for scenes, from files and expressions.
#pragma once

#include <string>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/forward.h"

namespace nef::planner {

/// The set in a mesh or nef file, by extension; meshes of other formats are read through assimp.
/// A mesh that bounds no solid becomes a surface, with a message. `mean`, if not null, receives the
/// mean of the mesh's vertices (as assimp joins them). Throws InputError.
Polyhedron read_shape_file(const std::string& path, Messages* messages, Rational3* mean = nullptr,
                           const Monitor& monitor = {});

/// What a string in a scene stands for: a file (relative to `folder`) or an expression of `nef eval`.
Polyhedron shape_of_text(const std::string& text, const std::string& folder, Messages* messages,
                         const Monitor& monitor = {});

/// A mesh file through assimp: all meshes of the scene with their transformations; faces that occur
/// twice (double-sided models) are kept once, vertices at equal places are one.
Mesh read_with_assimp(const std::string& path, Rational3* mean);

}  // namespace nef::planner
