// SPDX-License-Identifier: Apache-2.0
//
// What makes sets out of sets: operators, topological operations, maps and pieces. Each is a call of the function of
// nef/polyhedron.h through `call`, which releases Python's lock for all but small sets and watches for interrupts.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "binding/base/bindings.h"
#include "binding/base/set_hash.h"
#include "nef/parts/by_volume.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"

namespace nef::python {
AffineMap map_from(py::handle matrix) {
  std::vector<std::vector<Rational>> rows;
  for (const py::handle row : to_items(matrix, "a matrix")) {
    std::vector<Rational>& numbers = rows.emplace_back();
    for (const py::handle number : to_items(row, "each row of a matrix")) numbers.push_back(to_rational(number));
    if (numbers.size() != 3 && numbers.size() != 4) rows.resize(5);
    if (rows.size() > 4) break;
  }
  if (rows.size() < 3 || rows.size() > 4) throw InputError("a transformation needs the shape (4, 4), (3, 4) or (3, 3)");
  Rational weight = 1;
  if (rows.size() == 4) {
    if (rows[3].size() != 4 || rows[3][0] != 0 || rows[3][1] != 0 || rows[3][2] != 0 || rows[3][3] == 0) {
      throw InputError("the last row of a transformation must be 0, 0, 0, w with w other than 0");
    }
    weight = rows[3][3];
  }
  AffineMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) map.linear[i][j] = rows[i][j] / weight;
    if (rows[i].size() == 4) map.translation[i] = rows[i][3] / weight;
  }
  return map;
}

namespace {

// "z" or three numbers.
Rational3 axis_from(py::handle axis) {
  if (!PyUnicode_Check(axis.ptr())) return to_triple(axis, "an axis");
  const auto name = py::cast<std::string>(axis);
  if (name == "x") return {1, 0, 0};
  if (name == "y") return {0, 1, 0};
  if (name == "z") return {0, 0, 1};
  throw InputError("an axis is 'x', 'y', 'z' or three numbers, such as (0, 0, 1), not '" + name + "'");
}

using Unary = Polyhedron (*)(const Polyhedron&, const Monitor&);
using Binary = Polyhedron (*)(const Polyhedron&, const Polyhedron&, const Monitor&);

auto unary(Unary operation) {
  return [operation](const Polyhedron& a) {
    return call(items(a), [=](const Monitor& monitor) { return operation(a, monitor); });
  };
}

auto binary(Binary operation) {
  return [operation](const Polyhedron& a, const Polyhedron& b) {
    return call(items(a) + items(b), [=](const Monitor& monitor) { return operation(a, b, monitor); });
  };
}

// The same for steps of loops.
auto step(Polyhedron::Step kind, Binary operation) {
  return [kind, operation](const MaybeWaiting& a, const Polyhedron& b) {
    std::optional<Polyhedron> waiting = Polyhedron::waiting(kind, a.set, b);
    if (waiting) return *std::move(waiting);
    return call(items(a) + items(b), [=](const Monitor& monitor) {
      a.set.compute(monitor);
      return operation(a.set, b, monitor);
    });
  };
}

bool is_subset(const Polyhedron& a, const Polyhedron& b) {
  return call(items(a) + items(b), [=](const Monitor& monitor) { return subtract(a, b, monitor).is_empty(); });
}

bool is_same(const Polyhedron& a, const Polyhedron& b) {
  return call(items(a) + items(b), [=](const Monitor& monitor) { return equal(a, b, monitor); });
}

Polyhedron transformed(const Polyhedron& a, const AffineMap& map) {
  return call(items(a), [=](const Monitor& monitor) { return transform(a, map, monitor); });
}

AffineMap scaling(py::handle factors) {
  if (PySequence_Check(factors.ptr()) != 0 && !PyUnicode_Check(factors.ptr())) {
    return AffineMap::scale(to_triple(factors, "a scaling"));
  }
  const Rational factor = to_rational(factors);
  return AffineMap::scale({factor, factor, factor});
}

void require_kind_of_parts(const std::string& by) {
  if (by != "components" && by != "volumes") throw InputError("by must be 'components' or 'volumes'");
}

std::vector<Polyhedron> all_parts(const Polyhedron& a, const std::string& by, const Monitor& monitor) {
  return by == "volumes" ? split_volumes(a, monitor) : split(a, monitor);
}

std::vector<Polyhedron> parts(const Polyhedron& a, const std::string& by, const py::object& above) {
  require_kind_of_parts(by);
  std::optional<Rational> bound;
  if (!above.is_none()) bound = to_rational(above);
  return call(items(a), [a, by, bound](const Monitor& monitor) {
    std::vector<Polyhedron> found = all_parts(a, by, monitor);
    return bound ? pieces_above(std::move(found), *bound, monitor) : found;
  });
}

Polyhedron largest_part(const Polyhedron& a, const std::string& by) {
  require_kind_of_parts(by);
  return call(items(a), [a, by](const Monitor& monitor) {
    const std::vector<Polyhedron> found = all_parts(a, by, monitor);
    return found.empty() ? Polyhedron() : found[largest_piece(found, monitor)];
  });
}

}  // namespace

void bind_operations(PolyhedronClass& c) {
  c.def(py::init<>(), "The empty set.")
      .def("__or__", step(Polyhedron::Step::kUnite, unite), py::is_operator(), "Union.")
      .def("__add__", step(Polyhedron::Step::kUnite, unite), py::is_operator(), "Union, as ``|``.")
      .def("__and__", binary(intersect), py::is_operator(), "Intersection.")
      .def("__sub__", step(Polyhedron::Step::kSubtract, subtract), py::is_operator(), "Difference.")
      .def("__xor__", binary(symmetric_difference), py::is_operator(), "Symmetric difference.")
      .def(
          "__invert__",
          [](const Polyhedron& a) { return call(items(a), [=](const Monitor&) { return complement(a); }); },
          "Complement: all points that are not in the set.")
      .def("__eq__", &is_same, py::is_operator(), "True if both are the same set of points.")
      .def(
          "__ne__", [](const Polyhedron& a, const Polyhedron& b) { return !is_same(a, b); }, py::is_operator())
      .def("__le__", &is_subset, py::is_operator(), "Subset.")
      .def(
          "__ge__", [](const Polyhedron& a, const Polyhedron& b) { return is_subset(b, a); }, py::is_operator())
      .def(
          "__lt__", [](const Polyhedron& a, const Polyhedron& b) { return is_subset(a, b) && !is_subset(b, a); },
          py::is_operator())
      .def(
          "__gt__", [](const Polyhedron& a, const Polyhedron& b) { return is_subset(b, a) && !is_subset(a, b); },
          py::is_operator())
      .def(
          "isdisjoint",
          [](const Polyhedron& a, const Polyhedron& b) {
            return call(items(a) + items(b),
                        [=](const Monitor& monitor) { return intersect(a, b, monitor).is_empty(); });
          },
          py::arg("other"), "True if no point is in both sets.")
      .def("__hash__", &set_hash, "The same for equal sets. O(number of vertices).")
      .def("__bool__", [](const Polyhedron& a) { return !a.is_empty(); })
      .def("__copy__", [](const Polyhedron& a) { return a; })
      .def("__deepcopy__", [](const Polyhedron& a, const py::dict&) { return a; })
      .def("interior", unary(interior), "The largest open subset.")
      .def("closure", unary(closure), "The smallest closed set that contains the set.")
      .def("boundary", unary(boundary),
           "The points of which every neighbourhood meets both the set and its complement.")
      .def("exterior", unary(exterior), "The interior of the complement.")
      .def("regularize", unary(regularize), "The closure of the interior.")
      .def(
          "without_labels", unary(without_labels),
          "The points whose label is not 0, as an ordinary set: what Booleans and the like take a set with labels for.")
      .def(
          "transform", [](const Polyhedron& a, py::handle matrix) { return transformed(a, map_from(matrix)); },
          py::arg("matrix"),
          R"(The image under an affine map, exactly.

matrix: array or nested sequence of shape (4, 4), (3, 4) or (3, 3); every entry is converted exactly, from
Fractions as from floats. Raises InputError if the map is not invertible.)")
      .def(
          "translate",
          [](const Polyhedron& a, py::handle by) {
            return transformed(a, AffineMap::translate(to_triple(by, "a translation")));
          },
          py::arg("by"), "The set moved by a vector of three numbers.")
      .def(
          "scale", [](const Polyhedron& a, py::handle factors) { return transformed(a, scaling(factors)); },
          py::arg("factors"), "The set scaled about the origin by one number, or by three along the axes.")
      .def(
          "rotate",
          [](const Polyhedron& a, py::handle axis, double degrees, double tolerance) {
            return transformed(a, AffineMap::rotate(axis_from(axis), degrees, tolerance));
          },
          py::arg("axis"), py::arg("degrees"), py::arg("tolerance") = 1e-9,
          R"(The set turned about an axis through the origin, counterclockwise as seen from the tip of the axis.

axis: 'x', 'y', 'z' or three numbers. degrees: the angle. The map is exactly orthogonal and
rational; its angle is within `tolerance` degrees of the one given, and exact for multiples of 90 about x, y and z.)")
      .def("split", &parts, py::arg("by") = "components", py::arg("above") = py::none(),
           R"(The pieces of the set, a list of Polyhedron.

by='components': connected components; what touches in a point of the set is one. by='volumes': for each connected open
region of the set, the region and what the set has of its boundary. above: only pieces whose volume is above this one.)")
      .def("largest_piece", &largest_part, py::arg("by") = "components",
           "The piece of the largest volume of those that split gives, of several the first; empty if the set is.");
}

}  // namespace nef::python
