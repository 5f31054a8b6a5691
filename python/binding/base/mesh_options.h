// SPDX-License-Identifier: Apache-2.0
//
// How meshes are read, as arguments of Python's functions spell it.
#pragma once

#include <pybind11/pybind11.h>
#include <string>

#include "nef/construct/construct.h"

namespace nef::python {

/// Arguments `crossings` (the name of a rule) and `close` (the largest share of lids in the area in percent; 0 or
/// False: none; True: 10, as for the programs' --close without a number). Throws InputError with what they take.
MeshOptions mesh_options(const std::string& crossings, pybind11::handle close);

}  // namespace nef::python
