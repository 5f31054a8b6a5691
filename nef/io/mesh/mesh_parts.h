// SPDX-License-Identifier: Apache-2.0
//
// Named parts of a mesh in a file, and how paths name them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nef/io/mesh/face_groups.h"
#include "nef/mesh/mesh.h"

namespace nef {

/// A run of faces with a name: a group or object of OBJ, a node, mesh or material of GLB, an object of 3MF (by its id
/// if it has no name). Parts may contain each other, and several may have the same name.
struct MeshPart {
  std::string name;
  std::uint32_t first = 0;  ///< face
  std::uint32_t last = 0;   ///< behind the last face
};
using MeshParts = std::vector<MeshPart>;

/// "assembly.3mf#lid" is the part `lid` of assembly.3mf, unless there is a file of that whole name.
struct PartPath {
  std::string file;
  std::string part;  ///< empty: the whole file
};
PartPath part_path(const std::string& path);

/// The faces of all parts of that name with the vertices that they use, in order. Throws InputError with the names that
/// there are, if there is none. O(n).
Mesh faces_of_part(const Mesh& mesh, const MeshParts& parts, const PartPath& wanted);

/// The part of each face: the smallest that it belongs to. Parts of the same name are one, and faces of no part are in
/// one without a name. In the order of their first faces. O(n log n).
FaceGroups groups_of_parts(const Mesh& mesh, const MeshParts& parts);

/// A mesh and what it is called.
struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// The mesh in pieces by groups_of_parts, in their order. O(n log n).
std::vector<NamedMesh> split_into_parts(const Mesh& mesh, const MeshParts& parts);

}  // namespace nef
