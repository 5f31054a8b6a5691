// SPDX-License-Identifier: Apache-2.0
//
// The parts of the extension module nef._planner.
#pragma once

#include <pybind11/pybind11.h>

namespace nef::python {

/// Adds what nef.mechanisms is made of.
void bind_mechanisms(pybind11::module_& m);

}  // namespace nef::python
