// SPDX-License-Identifier: Apache-2.0
//
// The functions that an extension module has.
#pragma once

#include <pybind11/pybind11.h>

namespace nef::python {

/// Calls visit(value) for all that stands in a module and in its classes: functions, methods, and what is neither.
template <typename Visit>
void for_each_function(const pybind11::module_& module, const Visit& visit) {
  for (const auto& [name, value] : pybind11::reinterpret_borrow<pybind11::dict>(module.attr("__dict__"))) {
    visit(value);
    if (!pybind11::isinstance<pybind11::type>(value)) continue;
    for (const auto& [method_name, method] : pybind11::dict(value.attr("__dict__"))) visit(method);
  }
}

}  // namespace nef::python
