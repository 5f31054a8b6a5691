// SPDX-License-Identifier: Apache-2.0
//
// Readable errors for calls with wrong arguments.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

namespace nef::python {

/// Throws a TypeError that says in one line which argument is not of a type, which is as pybind11 writes it: "float".
[[noreturn]] void refuse_argument(const std::string& name, const std::string& type, pybind11::handle value);

/// The value as a T. Throws a TypeError that calls it `name` if it is none.
template <typename T>
T value_as(pybind11::handle value, const std::string& name) {
  pybind11::detail::make_caster<T> caster;
  if (!caster.load(value, true)) refuse_argument(name, pybind11::detail::make_caster<T>::name.text, value);
  return pybind11::detail::cast_op<T>(std::move(caster));
}

/// One of some named arguments, which is there.
template <typename T>
T argument(const pybind11::dict& arguments, const char* name) {
  const pybind11::object value = arguments[name];
  return value_as<T>(value, name);
}

/// Makes all functions of a module, and the methods of its classes, explain refused arguments in one line that names
/// the argument (nef/arguments.py), as a TypeError, instead of pybind11's list of types. Calls that are accepted cost
/// one more jump. Call it when all functions are defined.
void explain_arguments(const pybind11::module_& module);

}  // namespace nef::python
