// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._remeshing, of which nef.remeshing is made: arrays in, arrays out.
#include <pybind11/stl.h>

#include "apps/remeshing/decimate.h"
#include "apps/remeshing/subdivide.h"
#include "binding/base/arguments.h"
#include "binding/base/bindings.h"
#include "binding/base/errors.h"
#include "binding/meshes.h"

namespace nef::python {
namespace {

// (vertices, faces, low, high) of a mesh with about so many triangles, and the bounds of its distance from the set.
py::tuple decimate_set(const Polyhedron& set, std::size_t triangles, unsigned threads) {
  const DecimatedMesh made = call(items(set), [set, triangles, threads](const Monitor& monitor) {
    return decimate(set, triangles, monitor.on_threads(threads));
  });
  warn(made.notes);
  const py::tuple arrays = mesh_to_arrays(nearest(made.mesh), true);
  return py::make_tuple(arrays[0], arrays[1], made.distance.low, made.distance.high);
}

py::tuple subdivide_mesh(py::handle vertices, py::handle faces, unsigned times, bool smooth, bool exact) {
  const Mesh mesh = mesh_from_arrays(vertices, faces);
  const auto scheme = smooth ? SubdivisionScheme::kLoop : SubdivisionScheme::kMidpoint;
  const Mesh made = call(kSmallCall, [mesh, scheme, times](const Monitor&) { return subdivide(mesh, scheme, times); });
  return exact ? mesh_to_arrays(made, true) : mesh_to_arrays(nearest(made), true);
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_remeshing, m) {
  m.doc() = "The core of the package nef.remeshing; see there.";
  pybind11::module_::import("nef._nef");
  m.def("decimate", &nef::python::decimate_set);
  m.def("subdivide", &nef::python::subdivide_mesh);
  nef::python::explain_arguments(m);
}
