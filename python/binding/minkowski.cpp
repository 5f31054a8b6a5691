// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._minkowski.
#include "apps/minkowski/minkowski.h"

#include <pybind11/stl.h>

#include "binding/bindings.h"

namespace nef::python {
namespace {

minkowski::MinkowskiOptions options_of(unsigned threads, const ProgressFunction& progress) {
  minkowski::MinkowskiOptions options;
  options.threads = threads;
  options.progress = [progress](std::size_t done, std::size_t total) {
    progress(done, total);
    return true;
  };
  return options;
}

Polyhedron sum(const Polyhedron& a, const Polyhedron& b, unsigned threads, const py::object& progress) {
  const auto options = options_of(threads, ProgressFunction(progress));
  // Each cell of one is added to each of the other, so small operands may take long.
  return call(kSmallCall, [=] { return minkowski::minkowski_sum(a, b, options); });
}

Polyhedron configuration_space(const Polyhedron& robot, const std::vector<Polyhedron>& obstacles, const py::object& box,
                               unsigned threads, const py::object& progress) {
  std::optional<std::array<Rational3, 2>> bounds;
  if (!box.is_none()) {
    const py::sequence corners = box;
    if (corners.size() != 2) throw py::value_error("a box needs two corners");
    bounds = {to_triple(corners[0], "a corner"), to_triple(corners[1], "a corner")};
  }
  const auto options = options_of(threads, ProgressFunction(progress));
  return call(kSmallCall, [=] { return minkowski::configuration_space(robot, obstacles, bounds, options); });
}

std::vector<Polyhedron> decompose(const Polyhedron& a) {
  return call(kSmallCall, [a] {
    std::vector<Polyhedron> cells;
    for (const minkowski::ConvexCell& cell : minkowski::decompose(a)) {
      check_interruption();
      cells.push_back(minkowski::to_polyhedron(cell));
    }
    return cells;
  });
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_minkowski, m) {
  using namespace nef::python;
  m.doc() = "The core of the package nef.minkowski; see there.";
  py::module_::import("nef._nef");
  m.def("sum", &sum, py::arg("a"), py::arg("b"), py::arg("threads") = 1, py::arg("progress") = py::none(),
        R"(The Minkowski sum { x + y : x in a, y in b } of any two sets, exactly.

Open and closed parts, lower-dimensional parts and cavities count; empty if one is empty. threads: 0 for as many as the
machine has; the result does not depend on it. progress: a function that is called with (pairs of cells done, pairs in
all). Raises UnsupportedError for unbounded operands with too many reflex edges.)");
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
      [](const nef::Polyhedron& a) { return call(items(a), [a] { return nef::minkowski::is_convex(a); }); },
      py::arg("a"), "True if a bounded set is convex: a box without one point of an edge is not.");
  m.def(
      "negate", [](const nef::Polyhedron& a) { return call(items(a), [a] { return nef::minkowski::negate(a); }); },
      py::arg("a"), "The set of all -x with x in a.");
}
