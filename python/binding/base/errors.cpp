// SPDX-License-Identifier: Apache-2.0
#include "binding/base/errors.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "apps/program/expression/expression.h"

namespace nef::python {

namespace py = pybind11;

namespace {

void raise(const char* type, const Error& error, const py::dict& attributes) {
  const py::object exception = py::module_::import("nef.errors").attr(type);
  const py::object instance = exception(std::string(error.what()), **attributes);
  PyErr_SetObject(exception.ptr(), instance.ptr());
}

py::dict guilty_elements(const MeshError& error) {
  py::list vertices;
  py::list edges;
  py::list faces;
  for (const MeshProblem& problem : error.problems()) {
    if (problem.legal) continue;
    for (const std::uint32_t v : problem.vertices) vertices.append(v);
    for (const auto& edge : problem.edges) edges.append(py::make_tuple(edge[0], edge[1]));
    for (const std::uint32_t f : problem.faces) faces.append(f);
  }
  py::dict result;
  result["vertices"] = vertices;
  result["edges"] = edges;
  result["faces"] = faces;
  return result;
}

}  // namespace

void warn(const Messages& messages) {
  for (const std::string& message : messages) {
    if (PyErr_WarnEx(PyExc_UserWarning, message.c_str(), 2) != 0) throw py::error_already_set();
  }
}

void register_errors() {
  // pybind11 asks for a function of this type.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const MeshError& error) {
      raise("InputError", error, guilty_elements(error));
    } catch (const ExpressionError& error) {
      py::dict attributes;
      attributes["offset"] = error.offset();
      raise("InputError", error, attributes);
    } catch (const InputError& error) {
      raise("InputError", error, {});
    } catch (const UnsupportedError& error) {
      raise("UnsupportedError", error, {});
    } catch (const Error& error) {
      raise("Error", error, {});
    }
  });
}

}  // namespace nef::python
