// SPDX-License-Identifier: Apache-2.0
//
// The boundary of a Boolean of many sets, each face with the sets that it comes from.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nef/export/to_mesh.h"
#include "nef/operation/label_inputs.h"

namespace nef {

/// Whether a point that these of `count` inputs hold belongs to the result of an operation.
using Membership = bool (*)(const InputSet& inputs, std::size_t count);

/// That of "union", "intersection", "difference" (the first input without all others) or "symdiff" (the points of an
/// odd number of inputs). Throws InputError for another name.
Membership membership(std::string_view operation);

struct MeshWithOrigins {
  Mesh mesh;                      ///< as of to_mesh; exact
  std::vector<InputSet> origins;  ///< of each face: the inputs on whose boundary it lies
  std::vector<std::string> lost;  ///< what the mesh does not hold, as of to_mesh
};

/// The boundary of what an operation makes of the inputs. Facets are cut where they pass from one input to another. Of
/// the options, `selected` and `face_marks` are not read. Cost and errors are those of label_inputs and to_mesh.
MeshWithOrigins mesh_with_origins(std::span<const Polyhedron> inputs, Membership belongs,
                                  const MeshExportOptions& options = {}, const Monitor& monitor = {});

}  // namespace nef
