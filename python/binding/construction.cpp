// SPDX-License-Identifier: Apache-2.0
//
// Functions that make sets: from arrays, text and other sets. They copy what Python holds, compute without the
// interpreter's lock (`call`), and warn of what the library noted when they have the lock again.
#include <pybind11/stl.h>

#include <filesystem>
#include <mutex>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/program/expression/expression.h"
#include "apps/program/expression/openscad.h"
#include "binding/base/arguments.h"
#include "binding/base/bindings.h"
#include "binding/base/errors.h"
#include "binding/base/mesh_options.h"
#include "binding/meshes.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/import/repair.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"

namespace nef::python {
namespace {

Polyhedron box(py::handle low, py::handle high) {
  return make_box(to_triple(low, "a corner"), to_triple(high, "a corner"));
}

Polyhedron halfspace(py::handle a, py::handle b, py::handle c, py::handle d, bool closed) {
  return make_halfspace(to_rational(a), to_rational(b), to_rational(c), to_rational(d), closed);
}

unsigned corners_around(unsigned corners, unsigned most) {
  if (corners < 3 || corners > most) {
    throw InputError("corners must be from 3 to " + std::to_string(most) + ", not " + std::to_string(corners));
  }
  return corners;
}

Polyhedron sphere(py::handle radius, unsigned corners) {
  const Rational r = to_rational(radius);
  if (r <= 0) throw InputError("radius must be positive");
  const unsigned around = corners_around(corners, kMostCornersOfBall);
  return call(std::size_t{around} * around, [=](const Monitor& monitor) { return make_sphere(r, around, monitor); });
}

Polyhedron cylinder(py::handle height, py::handle radius, const py::object& top, unsigned corners) {
  const Rational h = to_rational(height);
  const Rational bottom = to_rational(radius);
  const Rational above = top.is_none() ? bottom : to_rational(top);
  if (h <= 0) throw InputError("height must be positive");
  if (bottom < 0 || above < 0 || (bottom == 0 && above == 0)) {
    throw InputError("radius and top must not be negative, and one of them must be positive");
  }
  const unsigned around = corners_around(corners, kMostCornersOfCircle);
  return call(2 * around, [=](const Monitor& monitor) { return make_cylinder(h, bottom, above, around, monitor); });
}

// The first item of a sequence; nothing of what is none, or is empty.
py::object first_item(py::handle value) {
  if (!py::isinstance<py::sequence>(value) || py::isinstance<py::str>(value) || py::len(value) == 0) return py::none();
  return value[py::int_(0)];
}

Polyhedron hull(py::handle points) {
  if (py::isinstance<Polyhedron>(points) || py::isinstance<Polyhedron>(first_item(points))) {
    throw py::type_error("points must be points; the hull of sets is nef.minkowski.hull(a), or of a | b for two");
  }
  std::vector<Rational3> held = to_points(points, "points");
  const std::size_t count = held.size();
  return call(count, [held = std::move(held)](const Monitor& monitor) { return convex_hull(held, monitor); });
}

Polyhedron polygon(const py::iterable& rings) {
  const py::object coordinate = first_item(first_item(rings));
  if (!coordinate.is_none() && (py::isinstance<py::str>(coordinate) || !py::isinstance<py::iterable>(coordinate))) {
    throw InputError("rings must be a list of rings, each a list of points; write [ring] for a single one");
  }
  std::vector<std::vector<Rational3>> held;
  for (const py::handle ring : rings) held.push_back(to_points(ring, "each list in rings"));
  return make_polygon(held);
}

Polyhedron solid_from_mesh(py::handle vertices, py::handle faces, bool strict, bool surface, bool check,
                           const std::string& crossings, py::handle close) {
  const auto mesh = std::make_shared<const Mesh>(mesh_from_arrays(vertices, faces));
  MeshOptions options = mesh_options(crossings, close);
  options.strict = strict;
  options.as_surface = surface;
  options.check = check;
  using Made = std::pair<Polyhedron, Messages>;
  const Made made =
      call(mesh->vertices.size() + mesh->face_count(), [mesh, options](const Monitor& monitor) mutable -> Made {
        Messages messages;
        options.monitor = monitor;
        try {
          Polyhedron set = from_mesh(*mesh, options, &messages);
          return {std::move(set), std::move(messages)};
        } catch (const InputError& error) {
          throw MeshError(error.what(), check_mesh(*mesh, {}, monitor));
        }
      });
  warn(made.second, 2);
  return made.first;
}

py::object repaired(py::handle vertices, py::handle faces, bool strict, bool fill_holes, const std::string& crossings,
                    py::handle close) {
  const auto mesh = std::make_shared<const Mesh>(mesh_from_arrays(vertices, faces));
  const MeshOptions rule = mesh_options(crossings, close);
  const RepairOptions options{.fill_holes = fill_holes,
                              .close_percent = rule.close_percent,
                              .crossings = rule.crossings,
                              .strict = strict,
                              .record = true};
  const auto made = call(mesh->vertices.size() + mesh->face_count(), [mesh, options](const Monitor& monitor) {
    return std::make_shared<const RepairedMesh>(repair_mesh(*mesh, options, monitor));
  });
  py::list fates;
  for (const FaceFate fate : made->record.fates) fates.append(name(fate));
  py::dict volumes;
  if (made->resolved) {
    for (const auto& [winding, entry] : made->resolved->volumes) {
      if (entry.parts == 0) continue;
      const py::object volume = result_of("Measured", py::make_tuple(entry.measured.value, entry.measured.error));
      volumes[py::int_(winding)] = py::make_tuple(entry.parts, volume);
    }
  }
  const bool solid = made->problem.empty();
  warn(made->notes, 2);
  return result_of(
      "Repair",
      py::make_tuple(
          solid ? py::cast(made->set) : py::none(),
          solid ? py::object(py::none())
                : py::object(py::str(in_words_of_python(made->problem + advice_about(*made, options.close_percent)))),
          made->done, fates, made->record.added, made->record.pieces.kept, made->record.pieces.dropped, volumes,
          made->holes, made->lid_share, made->has_lids));
}

Polyhedron evaluate(const std::string& text, const std::string& crossings, py::handle close) {
  const MeshOptions meshes = mesh_options(crossings, close);
  using Made = std::pair<Polyhedron, Messages>;
  const bool openscad = lower_extension(text) == "csg";
  // An expression may take any amount of work.
  const Made made = call(kSmallCall, [text, meshes, openscad](const Monitor& monitor) -> Made {
    std::mutex noting;
    Messages notes;
    ExpressionOptions options;
    const std::filesystem::path folder = openscad ? std::filesystem::path(text).parent_path() : "";
    options.load = [&](const std::string& file, const Monitor& watching) {
      const std::string path = (folder / file).string();
      Messages of_file;
      MeshOptions watched = meshes;
      watched.monitor = watching;
      Polyhedron set = read_polyhedron(path, watched, &of_file);
      const std::lock_guard<std::mutex> lock(noting);
      notes.insert(notes.end(), of_file.begin(), of_file.end());
      return set;
    };
    options.warn = [&](const std::string& note) {
      const std::lock_guard<std::mutex> lock(noting);
      notes.push_back(note);
    };
    options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& watching) {
      return minkowski::minkowski_sum(a, b, {.monitor = watching});
    };
    options.ball = minkowski::inner_ball;
    options.hull = minkowski::hull;
    options.monitor = monitor;
    Polyhedron set = openscad ? evaluate_openscad(read_file(text), options) : evaluate_expression(text, options);
    return {std::move(set), std::move(notes)};
  });
  warn(made.second);
  return made.first;
}

Polyhedron many(const py::iterable& iterable, unsigned threads, bool unite) {
  const std::vector<Polyhedron> sets = sets_of(iterable);
  return call(items(sets), [=](const Monitor& monitor) {
    const Monitor of_all = monitor.on_threads(threads);
    return unite ? unite_all(sets, of_all) : intersect_all(sets, of_all);
  });
}

// The function is called beforehand for every pair of labels that occur, with the interpreter's lock.
Polyhedron overlay_labels(const Polyhedron& a, const Polyhedron& b, const py::function& function) {
  const std::size_t rows = a.complex().label_count;
  const std::size_t columns = b.complex().label_count;
  auto table = std::make_shared<std::vector<LabelId>>(rows * columns);
  for (std::size_t x = 0; x < rows; ++x) {
    for (std::size_t y = 0; y < columns; ++y) {
      const auto label = value_as<long>(function(x, y), "a label that the function gives");
      if (label < 0 || label >= kOutside) throw InputError("labels are numbers from 0 to 65534");
      (*table)[x * columns + y] = static_cast<LabelId>(label);
    }
  }
  return call(items(a) + items(b), [=](const Monitor& monitor) {
    const auto combined = [&](LabelId x, LabelId y) {
      // The overlay tabulates at least labels 0 and 1.
      return x < rows && y < columns ? (*table)[x * columns + y] : LabelId{0};
    };
    return overlay(a, b, combined, monitor);
  });
}

}  // namespace

void bind_construction(py::module_& m) {
  m.def("box", &box, py::arg("low"), py::arg("high"),
        R"(The closed box between two corners.

low, high: three numbers each. A box that is flat in some directions is a facet, a segment or a point. Raises InputError
if low > high in one of them.)");
  m.def("halfspace", &halfspace, py::arg("a"), py::arg("b"), py::arg("c"), py::arg("d"), py::arg("closed") = true,
        "The points with a x + b y + c z + d <= 0 (< 0 if not closed). Raises InputError if a, b and c are 0.");
  m.def("hull", &hull, py::arg("points"),
        R"(The closed convex hull of points, of whatever dimension it is.

points: an array of shape (N, 3) of floats, integers or Fractions, or a sequence of triples.)");
  m.def(
      "point", [](py::handle p) { return make_point(to_triple(p, "a point")); }, py::arg("point"),
      "The set of one point.");
  m.def(
      "segment",
      [](py::handle a, py::handle b) { return make_segment(to_triple(a, "a point"), to_triple(b, "a point")); },
      py::arg("a"), py::arg("b"), "The closed segment between two points.");
  m.def("polygon", &polygon, py::arg("rings"),
        R"(A closed planar polygon: outer rings and holes in one plane, in any order.

rings: an iterable of arrays of shape (N, 3); write ``[ring]`` for a single one. Raises InputError if the points do not
lie in one plane exactly, or a ring touches or crosses itself.)");
  m.def("_from_mesh", &solid_from_mesh, py::arg("vertices"), py::arg("faces"), py::arg("strict"), py::arg("surface"),
        py::arg("check"), py::arg("crossings"), py::arg("close"));
  m.def("_repair", &repaired, py::arg("vertices"), py::arg("faces"), py::arg("strict"), py::arg("fill_holes"),
        py::arg("crossings"), py::arg("close"));
  m.def("eval", &evaluate, py::arg("text"), py::arg("crossings") = "refuse", py::arg("close") = 0.0,
        R"doc(The set that an expression of ``nef eval`` describes: ``nef.eval("box(0,0,0, 2,2,2) - ball(1, 4)")``.

Numbers in it are exact: 0.1 is one tenth. text: an expression in the whole language of `nef eval --help`, or the name of a
.csg file of OpenSCAD. crossings, close: as of from_mesh, for the mesh files that it names. Raises InputError, whose
`offset` is the place of the error.)doc");
  m.def(
      "sphere", &sphere, py::arg("radius"), py::arg("corners") = 32,
      R"(A polyhedron with its vertices on a sphere about the origin, as sphere() of ``nef eval`` and OpenSCAD make it.

corners: around, from 3 to 4000. minkowski.ball has smaller errors, and an outer one, for the same number of vertices.)");
  m.def("cylinder", &cylinder, py::arg("height"), py::arg("radius"), py::arg("top") = py::none(),
        py::arg("corners") = 32,
        R"(A cylinder about the z axis, from z = 0 up to `height`; with `top`, its radius up there, a piece of a cone.

corners: around, from 3 to 100000.)");
  m.def(
      "unite_all", [](const py::iterable& sets, unsigned threads) { return many(sets, threads, true); },
      py::arg("sets"), py::arg("threads") = 1,
      "The union of the sets of an iterable; the empty set for none. threads: 0 for as many as the machine has.");
  m.def(
      "intersect_all", [](const py::iterable& sets, unsigned threads) { return many(sets, threads, false); },
      py::arg("sets"), py::arg("threads") = 1,
      "The intersection of the sets of an iterable; all of space for none. threads: 0 for as many as the machine has.");
  m.attr("_progress") = progress_variable();
  m.def("everything", &Polyhedron::everything, "All of space.");
  m.def("overlay", &overlay_labels, py::arg("a"), py::arg("b"), py::arg("function"),
        R"(The set whose points carry the label function(label in a, label in b).

Labels are ints from 0; an ordinary set has 1 where it is and 0 elsewhere. Whatever else takes a set takes the points whose
label is not 0. The function is called once for each pair of
labels, also for pairs that occur nowhere.)");
}

}  // namespace nef::python
