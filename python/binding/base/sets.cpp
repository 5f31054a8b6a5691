// SPDX-License-Identifier: Apache-2.0
#include "binding/base/bindings.h"

namespace nef::python {

std::vector<Polyhedron> sets_of(const py::iterable& sets) {
  std::vector<Polyhedron> result;
  for (const py::handle set : sets) {
    if (!py::isinstance<Polyhedron>(set)) {
      throw py::type_error("sets must be of type Polyhedron, not " + std::string(Py_TYPE(set.ptr())->tp_name));
    }
    result.push_back(set.cast<const Polyhedron&>());
  }
  return result;
}

}  // namespace nef::python
