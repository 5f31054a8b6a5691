// SPDX-License-Identifier: Apache-2.0
//
// Readable errors for calls with wrong arguments.
#pragma once

#include <pybind11/pybind11.h>

namespace nef::python {

/// Makes all functions of a module, and the methods of its classes, explain refused arguments in one line that names
/// the argument (nef/arguments.py), as a TypeError, instead of pybind11's list of types. Calls that are accepted cost
/// one more jump. Call it when all functions are defined.
void explain_arguments(const pybind11::module_& module);

}  // namespace nef::python
