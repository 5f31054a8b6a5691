// SPDX-License-Identifier: Apache-2.0
#include "binding/base/arguments.h"
#include "binding/base/bindings.h"
#include "binding/base/errors.h"
#include "binding/base/signatures.h"
#include "nef/polyhedron.h"
#include "nef/version.h"

PYBIND11_MODULE(_nef, module) {
  module.doc() = "The core of the package nef; see there.";
  nef::python::register_errors();
  nef::python::PolyhedronClass polyhedron(module, "Polyhedron", R"(An exact set of points in space.

Any set made from half-spaces by intersection and complement: open or closed, bounded or not, of mixed dimension.
Immutable; copies share their memory. Made by nef.box, nef.halfspace, nef.hull, nef.from_mesh, nef.read, nef.eval and
by operations. Operators are those of Python's sets: ``|`` (or ``+``), ``&``, ``-``, ``^``, ``~`` (complement), ``==``, ``<=``
(subset), ``in``; a set is true if it is not empty.)");
  nef::python::bind_operations(polyhedron);
  nef::python::bind_queries(module, polyhedron);
  nef::python::bind_measures(module, polyhedron);
  nef::python::bind_files(module, polyhedron);
  nef::python::bind_construction(module);
  nef::python::bind_view(module);
  nef::python::bind_tiles(module);
  module.attr("__version__") = NEF_VERSION;
  nef::python::give_signatures(module);
  nef::python::explain_arguments(module);
}
