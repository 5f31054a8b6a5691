// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._minkowski: the functions of apps/minkowski with their docstrings, which the package
// nef.minkowski re-exports. Arguments are converted while Python's lock is held, and computed with after it is released
// (`call`).
#include "apps/minkowski/minkowski.h"

#include <pybind11/stl.h>

#include "apps/minkowski/morphology.h"

#include "binding/base/bindings.h"
#include "nef/distance/distance.h"
#include "nef/polyhedron.h"

namespace nef::python {
namespace {

minkowski::MinkowskiOptions options_of(unsigned threads, const ProgressFunction& progress, const Monitor& monitor) {
  minkowski::MinkowskiOptions options;
  options.threads = threads;
  options.progress = [progress, monitor](std::size_t done, std::size_t total) {
    progress(monitor, done, total);
    return true;
  };
  options.monitor = monitor;
  return options;
}

using Binary = Polyhedron (*)(const Polyhedron&, const Polyhedron&, const minkowski::MinkowskiOptions&,
                              minkowski::MinkowskiReport*);

// Each cell of one operand is combined with each of the other, so small ones may take long.
auto binary(Binary operation) {
  return [operation](const Polyhedron& a, const Polyhedron& b, unsigned threads, const py::object& progress) {
    const ProgressFunction told(progress);
    return call(kSmallCall,
                [=](const Monitor& monitor) { return operation(a, b, options_of(threads, told, monitor), nullptr); });
  };
}

minkowski::Side side_of(const std::string& name) {
  if (name == "inner") return minkowski::Side::kInner;
  if (name == "outer") return minkowski::Side::kOuter;
  throw py::value_error("side must be 'inner' or 'outer'");
}

Polyhedron offset(const Polyhedron& a, py::handle radius, int detail, const std::string& side, unsigned threads,
                  const py::object& progress) {
  const Rational r = to_rational(radius);
  const minkowski::Side kind = side_of(side);
  const ProgressFunction told(progress);
  return call(kSmallCall, [=](const Monitor& monitor) {
    return minkowski::offset(a, r, detail, kind, options_of(threads, told, monitor));
  });
}

Polyhedron ball(py::handle radius, int detail, const std::string& side) {
  return minkowski::to_polyhedron(minkowski::ball_approximation(to_rational(radius), detail, side_of(side)).cell);
}

py::object ball_error(py::handle radius, int detail, const std::string& side) {
  return to_fraction(minkowski::ball_approximation(to_rational(radius), detail, side_of(side)).error);
}

Polyhedron configuration_space(const Polyhedron& robot, const std::vector<Polyhedron>& obstacles, const py::object& box,
                               unsigned threads, const py::object& progress) {
  std::optional<std::array<Rational3, 2>> bounds;
  if (!box.is_none()) {
    const py::sequence corners = box;
    if (corners.size() != 2) throw py::value_error("a box needs two corners");
    bounds = {to_triple(corners[0], "a corner"), to_triple(corners[1], "a corner")};
  }
  const ProgressFunction told(progress);
  return call(kSmallCall, [=](const Monitor& monitor) {
    return minkowski::configuration_space(robot, obstacles, bounds, options_of(threads, told, monitor));
  });
}

Polyhedron sweep(const Polyhedron& a, py::handle path, unsigned threads, const py::object& progress) {
  const std::vector<Rational3> points = to_points(path, "a path");
  const ProgressFunction told(progress);
  return call(kSmallCall,
              [=](const Monitor& monitor) { return minkowski::sweep(a, points, options_of(threads, told, monitor)); });
}

py::object penetration(const Polyhedron& a, const Polyhedron& b, unsigned threads, const py::object& progress) {
  const ProgressFunction told(progress);
  const minkowski::Penetration found = call(kSmallCall, [=](const Monitor& monitor) {
    return minkowski::penetration(a, b, options_of(threads, told, monitor));
  });
  return result_of("Penetration", py::make_tuple(contact_name(found.kind), from_triple(found.translation),
                                                 to_fraction(found.squared_length)));
}

py::object reach(const Polyhedron& tool, const Polyhedron& part, const py::object& start, unsigned threads,
                 const py::object& progress) {
  std::optional<Rational3> from;
  if (!start.is_none()) from = to_triple(start, "a start");
  const ProgressFunction told(progress);
  const minkowski::Reach found = call(kSmallCall, [=](const Monitor& monitor) {
    return minkowski::reach(tool, part, from, options_of(threads, told, monitor));
  });
  return result_of("Reach", py::make_tuple(found.positions, found.touched, found.untouched));
}

Polyhedron component(const Polyhedron& a, const py::object& point) {
  std::optional<Rational3> inside;
  if (!point.is_none()) inside = to_triple(point, "a point");
  return call(items(a), [=](const Monitor& monitor) { return minkowski::component_of(a, inside, monitor); });
}

std::vector<Polyhedron> decompose(const Polyhedron& a) {
  return call(kSmallCall, [a](const Monitor& monitor) {
    std::vector<Polyhedron> cells;
    for (const minkowski::ConvexCell& cell : minkowski::decompose(a, monitor)) {
      monitor.check_interruption();
      cells.push_back(minkowski::to_polyhedron(cell, monitor));
    }
    return cells;
  });
}

void define_module(py::module_& m) {
  m.doc() = "The core of the package nef.minkowski; see there.";
  py::module_::import("nef._nef");
  const auto bind = [&m](const char* name, Binary operation, const char* text) {
    m.def(name, binary(operation), py::arg("a"), py::arg("b"), py::arg("threads") = 1, py::arg("progress") = py::none(),
          text);
  };
  bind("sum", nef::minkowski::minkowski_sum,
       R"(The Minkowski sum { x + y : x in a, y in b } of any two sets, exactly.

Open and closed parts, lower-dimensional parts and cavities count; empty if one is empty. threads: 0 for as many as the
machine has; the result does not depend on it. progress: a function that is called with (pairs of cells done, pairs in
all). Raises UnsupportedError for unbounded operands with too many reflex edges.)");
  bind("erode", nef::minkowski::erode,
       R"(The Minkowski difference: the points x for which b, moved by x, lies in a; exactly.

All of space if b is empty. threads, progress, errors: as for sum.)");
  bind("opening", nef::minkowski::opening,
       R"(a eroded by b, plus b: the union of all translates of b that lie in a.

threads, progress, errors: as for sum; progress begins anew with the second sum. Raises InputError if b is empty.)");
  bind("closing", nef::minkowski::closing,
       R"(a plus b, eroded by b: what no translate of -b reaches that misses a.

threads, progress, errors: as for opening.)");
  m.def("offset", &offset, py::arg("a"), py::arg("radius"), py::arg("detail") = 8, py::arg("side") = "outer",
        py::arg("threads") = 1, py::arg("progress") = py::none(),
        R"(The set grown by a ball of the radius, a number; shrunk for a negative one.

The round ball is replaced by a polyhedron, so that the result lies around what the round one would give (side='outer') or
inside of it ('inner'), and is exact for a ball whose radius is off by at most ball_error(abs(radius), detail, s), where s is
`side`, or the other one for a negative radius. detail: from 1 to 64, see ball. threads, progress, errors: as for sum.)");
  m.def("ball", &ball, py::arg("radius"), py::arg("detail") = 8, py::arg("side") = "inner",
        R"(A polyhedral ball about the origin: an octahedron whose edges are split into `detail` parts, from 1 to 64.

side: 'inner' puts all 4 detail^2 + 2 vertices exactly onto the sphere, 'outer' scales that until all facets are outside of it.
Raises InputError unless the radius, a number, is positive.)");
  m.def("ball_error", &ball_error, py::arg("radius"), py::arg("detail") = 8, py::arg("side") = "inner",
        "A bound on how far the surfaces of ball(radius, detail, side) and of the round ball are apart: a Fraction.");
  m.def("sweep", &sweep, py::arg("a"), py::arg("path"), py::arg("threads") = 1, py::arg("progress") = py::none(),
        R"(What a set passes over as it moves along a polyline of at least one point, in the order of its points.

path: points in rows. threads, progress, errors: as for sum.)");
  m.def(
      "penetration", &penetration, py::arg("a"), py::arg("b"), py::arg("threads") = 1, py::arg("progress") = py::none(),
      R"(How two bounded sets stand to each other, and the shortest translation of b that makes them touch: nef.Penetration.

The way out if they overlap, to contact if they are disjoint; closures and interiors decide. Exact. threads, progress: as for
sum. Raises InputError if one is empty, UnsupportedError if one is unbounded.)");
  bind(
      "no_fit", nef::minkowski::no_fit_set,
      R"(All translations of b for which a and b touch without overlap: facets, edges and points, slots that b fits exactly
among them.

threads, progress, errors: as for sum.)");
  m.def(
      "reach", &reach, py::arg("tool"), py::arg("part"), py::arg("start") = py::none(), py::arg("threads") = 1,
      py::arg("progress") = py::none(),
      R"(Where a translating tool can go outside of a part, from infinity or from `start`, and what it touches: nef.Reach.

Contact is free, and so are passages as wide as the tool. Both sets must be bounded (UnsupportedError). threads, progress: as
for sum. Raises InputError if the tool is empty or the start is not free.)");
  m.def("component", &component, py::arg("a"), py::arg("point") = py::none(),
        R"(The connected component of a set that holds a point, empty if the set does not hold it.

Without a point: what reaches infinity. Connected means by paths within the set, passages of dimension 1 and 0 included.)");
  m.def(
      "hull",
      [](const nef::Polyhedron& a) {
        return call(items(a), [a](const nef::Monitor& monitor) { return nef::minkowski::hull(a, monitor); });
      },
      py::arg("a"),
      R"(The convex hull of a set, open where the set is: the hull of an open set is open. nef.hull takes points.)");
  m.def("configuration_space", &configuration_space, py::arg("robot"), py::arg("obstacles"),
        py::arg("box") = py::none(), py::arg("threads") = 1, py::arg("progress") = py::none(),
        R"(Where a translating robot may be: the closed set of positions of its reference point, the origin.

robot: a Polyhedron; obstacles: a list of these, taken closed; box: two corners that bound the positions, or None. Contact
is free, so passages as narrow as the robot remain, as facets, edges and vertices.)");
  m.def("decompose", &decompose, py::arg("a"),
        R"(Convex sets whose union is exactly a bounded set: its vertical decomposition.

Those of dimension 3 come first; their interiors are disjoint. Raises UnsupportedError for an unbounded set.)");
  m.def(
      "is_convex",
      [](const nef::Polyhedron& a) {
        return call(items(a), [a](const nef::Monitor& monitor) { return nef::minkowski::is_convex(a, monitor); });
      },
      py::arg("a"), "True if a bounded set is convex: a box without one point of an edge is not.");
  m.def(
      "negate",
      [](const nef::Polyhedron& a) {
        return call(items(a), [a](const nef::Monitor& monitor) { return nef::minkowski::negate(a, monitor); });
      },
      py::arg("a"), "The set of all -x with x in a.");
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_minkowski, m) { nef::python::define_module(m); }
