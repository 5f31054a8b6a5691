// SPDX-License-Identifier: Apache-2.0
//
// OpenMesh's meshes of triangles, in doubles.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace nef {

struct TriangleMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<TriangleMeshTraits>;

}  // namespace nef
