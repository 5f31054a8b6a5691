// SPDX-License-Identifier: Apache-2.0
//
// What is asked about sets: properties, point location for one point or for arrays, rays, sections and
// distances. Arrays of doubles take the fast path (`locate_many`); other numbers are converted to rationals one by one.
// Exact results become Fractions, records become the named tuples of python/nef/results.py.
#include <pybind11/stl.h>

#include <set>

#include "binding/base/bindings.h"
#include "nef/distance/distance.h"
#include "nef/operation/for_each_mark.h"
#include "nef/parts/section.h"
#include "nef/query/locate_many.h"
#include "nef/query/location_name.h"

namespace nef::python {
bool is_one_point(py::handle points) {
  if (py::isinstance<py::array>(points)) return py::reinterpret_borrow<py::array>(points).ndim() == 1;
  if (PySequence_Check(points.ptr()) == 0 || PySequence_Size(points.ptr()) != 3) {
    PyErr_Clear();
    return false;
  }
  const py::object first = py::reinterpret_steal<py::object>(PySequence_GetItem(points.ptr(), 0));
  return PySequence_Check(first.ptr()) == 0 || PyUnicode_Check(first.ptr());
}

namespace {

py::object location_of(const Location& location) {
  return result_of("Location", py::make_tuple(location_name(location.kind), location.index, location.mark));
}

std::vector<LabelId> marks_at(const Polyhedron& a, py::handle points, unsigned threads) {
  if (const std::optional<DoubleArray> doubles = as_doubles(points)) {
    require_rows_of_three(*doubles, "points");
    const auto count = static_cast<std::size_t>(doubles->shape(0));
    static_assert(sizeof(std::array<double, 3>) == 3 * sizeof(double));
    const auto* rows = reinterpret_cast<const std::array<double, 3>*>(doubles->data());
    // A copy, so that what happens to the array meanwhile does not matter.
    auto held = std::make_shared<std::vector<std::array<double, 3>>>(rows, rows + count);
    return call(items(a) + count, [a, held, threads](const Monitor& monitor) {
      return locate_many(a, *held, monitor.on_threads(threads));
    });
  }
  auto exact = std::make_shared<std::vector<Rational3>>(to_points(points, "points"));
  return call(items(a) + exact->size(), [a, exact](const Monitor& monitor) {
    std::vector<LabelId> marks;
    for (const Rational3& p : *exact) {
      monitor.check_interruption();
      marks.push_back(locate(a, p).mark);
    }
    return marks;
  });
}

py::object contains_points(const Polyhedron& a, py::handle points, unsigned threads) {
  if (is_one_point(points)) {
    const Rational3 p = to_triple(points, "a point");
    const LockReleased unlocked;
    const bool in = contains(a, p);
    const LockHeld locked;
    return py::bool_(in);
  }
  const std::vector<LabelId> marks = marks_at(a, points, threads);
  py::array_t<bool> result(static_cast<py::ssize_t>(marks.size()));
  bool* out = result.mutable_data();
  for (const LabelId mark : marks) *out++ = mark != 0;
  return result;
}

py::object labels_at(const Polyhedron& a, py::handle points, unsigned threads) {
  if (is_one_point(points)) return py::int_(locate(a, to_triple(points, "a point")).mark);
  const std::vector<LabelId> marks = marks_at(a, points, threads);
  py::array_t<std::int64_t> result(static_cast<py::ssize_t>(marks.size()));
  std::copy(marks.begin(), marks.end(), result.mutable_data());
  return result;
}

py::object ray(const Polyhedron& a, py::handle origin, py::handle direction) {
  const Rational3 from = to_triple(origin, "an origin");
  const Rational3 towards = to_triple(direction, "a direction");
  const auto hit = call(items(a), [=](const Monitor& monitor) { return shoot_ray(a, from, towards, {}, monitor); });
  if (!hit) return py::none();
  return result_of("RayHit", py::make_tuple(from_triple(hit->point), location_of(hit->location)));
}

py::object rings_of(const SectionPolygon& polygon, bool exact) {
  py::list holes;
  for (const auto& hole : polygon.holes) holes.append(from_points(hole, exact));
  return result_of("Polygon", py::make_tuple(from_points(polygon.outer, exact), holes));
}

py::object section_of(const Polyhedron& a, py::handle normal, py::handle offset, bool exact) {
  const Rational3 n = to_triple(normal, "a normal");
  const Rational d = to_rational(offset);
  const Section cut = call(items(a), [=](const Monitor& monitor) { return section(a, n, d, monitor); });
  py::list polygons;
  for (const SectionPolygon& polygon : cut.polygons) polygons.append(rings_of(polygon, exact));
  py::list segments;
  for (const auto& segment : cut.segments) segments.append(from_points({segment[0], segment[1]}, exact));
  return result_of("Section",
                   py::make_tuple(cut.set, polygons, segments, from_points(cut.points, exact), cut.unbounded));
}

py::object distance_of(const Polyhedron& a, const Polyhedron& b) {
  const std::optional<Distance> found =
      call(items(a) + items(b), [=](const Monitor& monitor) { return distance(a, b, monitor); });
  if (!found) return py::none();
  return result_of("Distance",
                   py::make_tuple(contact_name(found->contact), found->common_point, found->value(),
                                  to_fraction(found->squared), from_triple(found->on_a), from_triple(found->on_b)));
}

py::object counts_of(const Polyhedron& a) {
  const Counts n = call(items(a), [a](const Monitor&) { return counts(a); });
  return result_of("Counts", py::make_tuple(n.vertices, n.edges, n.facets, n.volumes, n.shells));
}

std::vector<LabelId> labels_of(const Polyhedron& a) {
  std::set<LabelId> labels;
  for_each_mark(a.complex(), [&labels](LabelId mark) {
    if (mark != kOutside) labels.insert(mark);
  });
  return {labels.begin(), labels.end()};
}

}  // namespace

void bind_queries(py::module_& /*module*/, PolyhedronClass& c) {
  c.def("is_empty", &Polyhedron::is_empty, "True for the set without points. O(1).")
      .def("is_everything", &Polyhedron::is_everything, "True for all of space. O(1).")
      .def("is_bounded", &Polyhedron::is_bounded, "True if the set fits into some ball. O(1).")
      .def("is_open", &Polyhedron::is_open, "True if no boundary point is in the set. O(n).")
      .def("is_closed", &Polyhedron::is_closed, "True if every boundary point is in the set. O(n).")
      .def("is_regular", &Polyhedron::is_regular, "True if the set is the closure of its interior. O(n).")
      .def("contains", &contains_points, py::arg("points"), py::arg("threads") = 1,
           R"(Whether points are in the set, exactly.

points: three numbers for one point, which gives a bool; or an array of shape (N, 3) of floats, integers or Fractions,
which gives a bool array of shape (N,). threads: for arrays of floats; 0: as many as the machine has. Raises InputError
for a coordinate that is not a finite number.)")
      .def(
          "__contains__",
          [](const Polyhedron& a, py::handle p) {
            if (py::isinstance<Polyhedron>(p)) {
              throw InputError("a point needs three numbers; write b <= a for sets: whether b is a subset of a");
            }
            return contains(a, to_triple(p, "a point"));
          },
          py::arg("point"))
      .def("labels_at", &labels_at, py::arg("points"), py::arg("threads") = 1,
           "The labels at points: as contains, with integers for bools.")
      .def(
          "locate", [](const Polyhedron& a, py::handle p) { return location_of(locate(a, to_triple(p, "a point"))); },
          py::arg("point"),
          "The item that contains a point: nef.Location(kind, index, label), kind being 'vertex', 'edge', 'facet' or "
          "'volume'.")
      .def("ray", &ray, py::arg("origin"), py::arg("direction"),
           R"(The first vertex, edge or facet on the open ray from `origin` (excluded) in `direction` (not zero):
nef.RayHit(point, location), the point in Fractions; or None.)")
      .def("section", &section_of, py::arg("normal"), py::arg("offset"), py::arg("exact") = false,
           R"(The section with the plane of all points x with normal . x + offset = 0: nef.Section. The plane
z = 1 is ``section((0, 0, 1), -1)``.

Its `set` is exact; `polygons`, `segments` and `points` are the nearest doubles, or Fractions if `exact`. Raises
InputError if the normal is zero.)")
      .def("distance", &distance_of, py::arg("other"),
           R"(How far the closures of two sets are apart: nef.Distance, or None if one is empty.

Its `squared` is exact (a Fraction), as are the nearest points; `contact` is 'disjoint', 'touching' (the closures meet,
the interiors do not) or 'overlapping'; `common_point` is whether a point is in both sets themselves.)")
      .def("counts", &counts_of, "nef.Counts(vertices, edges, facets, volumes, shells), the outer volume included.")
      .def(
          "euler_numbers",
          [](const Polyhedron& a) { return call(items(a), [a](const Monitor&) { return euler_numbers(a); }); },
          "V - E + F of each shell of counts(); items at infinity do not count.")
      .def("labels", &labels_of, "The labels that points of space carry, increasing; 0 and 1 in an ordinary set.")
      .def(
          "validate",
          [](const Polyhedron& a) {
            return call(items(a), [a](const Monitor& monitor) { return validate(a.complex(), monitor); });
          },
          "The name of the first broken invariant of the complex, with the guilty items; empty, unless there is a "
          "bug.");
}

}  // namespace nef::python
