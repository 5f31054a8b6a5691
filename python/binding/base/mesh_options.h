// SPDX-License-Identifier: Apache-2.0
//
// How meshes are read, as arguments of Python's functions spell it.
#pragma once

#include <string>

#include "nef/construct/construct.h"

namespace nef::python {

/// Arguments `crossings` (the name of a rule) and `close` (the largest share of lids in the area in percent; 0: none).
/// Throws InputError with what they take.
MeshOptions mesh_options(const std::string& crossings, double close);

}  // namespace nef::python
