// SPDX-License-Identifier: Apache-2.0
//
// Meshes between arrays and the library.
#pragma once

#include "binding/base/numbers.h"
#include "nef/export/to_mesh.h"

namespace nef::python {

/// vertices: see to_points; faces: an integer array of shape (M, K), or a sequence of sequences of indices.
Mesh mesh_from_arrays(py::handle vertices, py::handle faces);

/// The mesh with the doubles nearest to its coordinates.
RoundedMesh nearest(const Mesh& mesh);

/// (vertices, faces): an array of shape (N, 3), and one of shape (M, 3) if `triangles`, else a list of M arrays. The
/// vertices are floats, in the memory of the mesh; or Fractions, of an exact one.
py::tuple mesh_to_arrays(RoundedMesh&& mesh, bool triangles);
py::tuple mesh_to_arrays(const Mesh& mesh, bool triangles);

}  // namespace nef::python
