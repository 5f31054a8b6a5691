// SPDX-License-Identifier: Apache-2.0
//
// Files, bytes, meshes. Each function copies its arguments, works without the interpreter's lock (`call`), and warns of
// what the library noted when it has the lock again. Arrays of plain meshes are the library's memory; those that were
// moved, repaired or separated come from exact coordinates.
#include <pybind11/stl.h>

#include <ctime>

#include "binding/base/bindings.h"
#include "binding/base/errors.h"
#include "binding/base/mesh_options.h"
#include "binding/meshes.h"
#include "nef/export/mesh_with_origins.h"
#include "nef/export/to_mesh.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/io/polyhedron_file.h"
#include "nef/io/solid_mesh.h"
#include "nef/polyhedron.h"

namespace nef::python {
std::string path_text(py::handle path) {
  const py::object text = py::module_::import("os").attr("fspath")(path);
  return py::cast<std::string>(py::module_::import("os").attr("fsdecode")(text));
}

namespace {

Polyhedron read(py::handle path, bool strict, bool surface, const std::string& crossings, py::handle close) {
  using Made = std::pair<Polyhedron, Messages>;
  const std::string file = path_text(path);
  MeshOptions options = mesh_options(crossings, close);
  options.strict = strict;
  options.as_surface = surface;
  const Made made = call(kSmallCall, [=](const Monitor& monitor) mutable -> Made {
    Messages messages;
    options.monitor = monitor;
    Polyhedron set = read_polyhedron(file, options, &messages);
    return {std::move(set), std::move(messages)};
  });
  warn(made.second);
  return made.first;
}

py::tuple floats_of(const Rational3& point) {
  return py::make_tuple(nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2]));
}

py::object write(const Polyhedron& a, py::handle path, bool exact, bool binary, bool polygons, bool manifold,
                 bool recenter, bool lenient, bool text, const std::string& format) {
  using Made = std::pair<WrittenFile, Messages>;
  const std::string file = path_text(path);
  PolyhedronWriteOptions options;
  options.exact = exact;
  options.binary = binary;
  options.polygons = polygons;
  options.manifold = manifold;
  options.recenter = recenter;
  options.lenient = lenient;
  options.text = text;
  options.format = format;
  // A file that is being written is finished, or never there: it is renamed into its place at the end.
  Made made = call(items(a), [=](const Monitor& monitor) mutable -> Made {
    Messages messages;
    options.monitor = monitor;
    WrittenFile written = write_polyhedron(file, a, options, &messages);
    return {std::move(written), std::move(messages)};
  });
  if (!made.first.problem.empty()) made.second.push_back(made.first.problem);
  warn(made.second);
  if (!recenter) return py::none();
  return floats_of(made.first.offset);
}

py::tuple mesh_of(const Polyhedron& a, bool polygons, bool exact, bool manifold, bool recenter, bool repair) {
  if (exact && repair) throw InputError("exact coordinates are not rounded, so there is nothing to repair");
  if (manifold || recenter || repair) {
    const SolidMesh made = call(items(a), [=](const Monitor& monitor) {
      return solid_mesh(
          a, {.polygons = polygons, .manifold = manifold, .recenter = recenter, .repair = repair, .monitor = monitor});
    });
    warn(made.notes);
    py::tuple arrays = exact ? mesh_to_arrays(made.mesh, !polygons) : mesh_to_arrays(nearest(made.mesh), !polygons);
    if (!recenter) return arrays;
    return py::make_tuple(arrays[0], arrays[1], exact ? from_triple(made.offset) : floats_of(made.offset));
  }
  MeshExportOptions options;
  options.keep_polygons = polygons;
  if (exact) {
    const MeshExport made = call(items(a), [=](const Monitor& monitor) { return to_mesh(a, options, monitor); });
    warn(made.lost);
    return mesh_to_arrays(made.mesh, !polygons);
  }
  RoundedMeshExport made = call(items(a), [=](const Monitor& monitor) { return to_rounded_mesh(a, options, monitor); });
  warn(made.lost);
  return mesh_to_arrays(std::move(made.mesh), !polygons);
}

py::object mesh_with_origins_of(const std::string& operation, const py::iterable& iterable, bool polygons, bool exact,
                                unsigned threads) {
  const std::vector<Polyhedron> sets = sets_of(iterable);
  const Membership belongs = membership(operation);
  MeshExportOptions options;
  options.keep_polygons = polygons;
  const MeshWithOrigins made = call(items(sets), [=](const Monitor& monitor) {
    return mesh_with_origins(sets, belongs, options, monitor.on_threads(threads));
  });
  warn(made.lost);
  const py::tuple arrays = exact ? mesh_to_arrays(made.mesh, !polygons) : mesh_to_arrays(nearest(made.mesh), !polygons);
  py::list origins;
  for (const InputSet& from : made.origins) origins.append(py::tuple(py::cast(from)));
  return result_of("MeshWithOrigins", py::make_tuple(arrays[0], arrays[1], origins));
}

// CPU seconds of from_mesh and to_rounded_mesh without Python: what bench/python sets its own times against.
py::tuple core_times(py::handle vertices, py::handle faces) {
  const Mesh mesh = mesh_from_arrays(vertices, faces);
  const LockReleased unlocked;
  const std::clock_t begin = std::clock();
  const Polyhedron set = from_mesh(mesh);
  const std::clock_t made = std::clock();
  static_cast<void>(to_rounded_mesh(set));
  const std::clock_t end = std::clock();
  const LockHeld locked;
  return py::make_tuple(static_cast<double>(made - begin) / CLOCKS_PER_SEC,
                        static_cast<double>(end - made) / CLOCKS_PER_SEC);
}

// With a checksum, so that damaged bytes are refused instead of being another set.
py::bytes bytes_of(const Polyhedron& a) {
  return call(items(a), [a](const Monitor&) { return native_binary(a); });
}

Polyhedron from_bytes(const std::string& bytes) {
  return call(bytes.size() / 100,
              [bytes](const Monitor& monitor) { return read_native(bytes, "pickled set", monitor); });
}

}  // namespace

void bind_files(py::module_& m, PolyhedronClass& c) {
  m.def("read", &read, py::arg("path"), py::arg("strict") = false, py::arg("surface") = false,
        py::arg("crossings") = "refuse", py::arg("close") = 0.0,
        R"(Reads a set from a file: .nef, .nef3 (CGAL's), or a mesh in any of the formats that docs/nef.md lists.

strict: refuse faces of meshes that are not exactly planar instead of triangulating them. surface: take a mesh as the
union of its faces. crossings: what is inside of a mesh that crosses itself, and close: how large lids for its holes may
be, as of from_mesh. Changes to the input are reported as InputWarning. Raises MissingFileError if there is no such file, and
InputError, which names file, line and cause, if it is bad.)");
  m.def("from_bytes", &from_bytes, py::arg("bytes"),
        "The set that Polyhedron.to_bytes wrote, of this or an earlier version. Raises InputError for damaged bytes.");
  m.def(
      "mesh_with_origins", &mesh_with_origins_of, py::arg("operation"), py::arg("sets"), py::arg("polygons") = false,
      py::arg("exact") = false, py::arg("threads") = 1,
      R"(The boundary of a Boolean as a mesh, and which of the sets each face comes from, as `nef union --origins` has it.

operation: "union", "intersection", "difference" (the first set without all others) or "symdiff" (the points of an odd
number of sets). sets: an iterable. polygons, exact: as of Polyhedron.to_mesh. threads: 0 for as many as the machine has. Returns a
MeshWithOrigins: vertices, faces and, for each face, the numbers of the sets on whose boundary it lies. Faces are cut
where they pass from one set to another.)");
  m.def("_core_times", &core_times, py::arg("vertices"), py::arg("faces"));
  c.def("write", &write, py::arg("path"), py::arg("exact") = false, py::arg("binary") = false,
        py::arg("polygons") = true, py::arg("manifold") = false, py::arg("recenter") = false,
        py::arg("lenient") = false, py::arg("text") = false, py::arg("format") = "",
        R"(Writes the set to a file; the extension selects the format.

exact: exact coordinates in meshes (not STL). binary: binary STL or PLY. polygons: faces without holes stay polygons where
rounding leaves them planar. manifold: where the solid touches itself, each sheet has vertices of its own (not in STL).
recenter: subtract a point of few digits near the middle of the mesh, and return it (three floats, exact); GLB and 3MF
files put it back when they are read. lenient: write a mesh even if rounding made it illegal and it could not be repaired, and
warn; otherwise that is an UnsupportedError. text: .nef as text. format: such as "off", instead of the extension. What a mesh cannot store (walls,
wires, unbounded volumes) is reported as InputWarning; open boundaries become closed.)")
      .def("to_mesh", &mesh_of, py::arg("polygons") = false, py::arg("exact") = false, py::kw_only(),
           py::arg("manifold") = false, py::arg("recenter") = false, py::arg("repair") = false,
           R"(The boundary of the set's volumes as a closed mesh: (vertices, faces).

vertices: array of shape (N, 3) of floats, the nearest to the exact coordinates; of Fractions if `exact`. faces: int64
array of shape (M, 3), counterclockwise as seen from outside; or, with `polygons`, a list of M arrays.
manifold: where the solid touches itself, each sheet gets vertices of its own. recenter: subtract a point near the middle
from the vertices, and return it as a third value (floats that are exact; Fractions if `exact`). repair: move vertices to
other floats nearby until no two triangles have anything in common but vertices and edges that they share, as `write`
does; UnsupportedError if that fails. Without it rounding may flip slivers. What a mesh cannot store (walls, wires,
unbounded volumes) is reported as InputWarning; open boundaries become closed.)")
      .def("to_bytes", &bytes_of, "The set in the binary native format, exact and with a checksum.")
      .def(py::pickle([](const Polyhedron& a) { return bytes_of(a); },
                      [](const py::bytes& bytes) { return from_bytes(std::string(bytes)); }));
}

}  // namespace nef::python
