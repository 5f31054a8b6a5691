// SPDX-License-Identifier: Apache-2.0
//
// Signatures that `inspect.signature` reads.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <string_view>

namespace nef::python {

/// The text signature of CPython, "box(low, high=0)\n--\n\n", of a line that pybind11 writes at the beginning of a
/// docstring, "box(low: handle, high: handle = 0) -> Polyhedron". Nothing for another line.
std::optional<std::string> text_signature(std::string_view line);

/// Puts text signatures in the docstrings of all functions of a module and of its classes. Call it when all functions
/// are defined. Functions with several overloads keep their docstrings.
void give_signatures(const pybind11::module_& module);

}  // namespace nef::python
