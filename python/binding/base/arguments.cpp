// SPDX-License-Identifier: Apache-2.0
#include "binding/base/arguments.h"

#include <cstring>
#include <string>

#include "binding/base/functions.h"

namespace nef::python {

namespace py = pybind11;

namespace {

// What pybind11 calls for every function of this extension module.
PyCFunctionWithKeywords dispatcher = nullptr;

// Whether a function is one of pybind11's, which keep their record in `self`.
bool is_bound(py::handle function) {
  if (!function || PyCFunction_Check(function.ptr()) == 0) return false;
  PyObject* const self = PyCFunction_GET_SELF(function.ptr());
  if (self == nullptr || PyCFunction_GET_FLAGS(function.ptr()) != (METH_VARARGS | METH_KEYWORDS)) return false;
  return PyCapsule_CheckExact(self) != 0 || std::strstr(Py_TYPE(self)->tp_name, "pybind11") != nullptr;
}

// Puts the error that is set in words if it is pybind11's about the arguments.
void explain(py::handle arguments, py::handle keywords) {
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) return;
  py::error_already_set error;
  std::string text = py::str(error.value());
  const bool of_pybind = text.find("(): incompatible ") != std::string::npos;
  if (!of_pybind) {
    error.restore();
    return;
  }
  try {
    const py::object given = keywords ? py::reinterpret_borrow<py::object>(keywords) : py::none();
    text = py::str(py::module_::import("nef.arguments").attr("complaint")(text, arguments, given));
  } catch (const py::error_already_set&) {
    // pybind11's own text is better than none, as while the interpreter ends.
  }
  PyErr_SetString(PyExc_TypeError, text.c_str());
}

PyObject* explained_call(PyObject* self, PyObject* arguments, PyObject* keywords) {
  PyObject* const result = dispatcher(self, arguments, keywords);
  if (result == nullptr) explain(arguments, keywords);
  return result;
}

void explain_function(py::handle value) {
  const py::handle function = py::detail::get_function(value);
  if (!is_bound(function)) return;
  PyMethodDef* const definition = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
  PyCFunction const explained = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&explained_call));
  if (definition->ml_meth == explained) return;  // a function of two names
  dispatcher = reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(definition->ml_meth));
  definition->ml_meth = explained;
}

}  // namespace

void refuse_argument(const std::string& name, const std::string& type, py::handle value) {
  throw py::type_error(py::str(py::module_::import("nef.arguments").attr("wrong_type")(name, type, value)));
}

void explain_arguments(const py::module_& module) { for_each_function(module, explain_function); }

}  // namespace nef::python
