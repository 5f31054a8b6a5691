// SPDX-License-Identifier: Apache-2.0
//
// Measures of sets: exact ones in Fractions, whose digits grow with the set, and doubles with proven bounds, in O(n).
#include <pybind11/stl.h>

#include "apps/program/set_info.h"
#include "binding/base/bindings.h"
#include "nef/query/measures/approximate_volume.h"
#include "nef/query/moments.h"

namespace nef::python {

namespace {

py::object optional_fraction(const std::optional<Rational>& value) { return value ? to_fraction(*value) : py::none(); }

py::tuple from_matrix(const Rational3x3& matrix) {
  return py::make_tuple(from_triple(matrix[0]), from_triple(matrix[1]), from_triple(matrix[2]));
}

py::array_t<double> floats_of(const std::array<std::array<double, 3>, 3>& matrix) {
  return py::array_t<double>({3, 3}, matrix[0].data());
}

py::object moments_of(const Polyhedron& a) {
  const std::optional<Moments> found = call(items(a), [a](const Monitor&) { return moments(a); });
  if (!found) return py::none();
  const std::optional<Rational3> centre = found->centroid();
  py::object centroid = py::none();
  py::object inertia = py::none();
  py::object principal = py::none();
  py::object axes = py::none();
  if (centre) {
    centroid = from_triple(*centre);
    inertia = from_matrix(found->inertia(*centre));
    const PrincipalInertia frame = principal_inertia(*found);
    principal = py::array_t<double>(3, frame.moments.data());
    axes = py::array_t<double>({3, 3}, frame.axes[0].data());
  }
  return result_of("Moments", py::make_tuple(to_fraction(found->volume), centroid, from_triple(found->first),
                                             from_matrix(found->second), inertia, principal, axes));
}

py::object box_of(const Polyhedron& a) {
  const auto box = call(items(a), [a](const Monitor&) { return bounding_box(a); });
  if (!box) return py::none();
  return py::make_tuple(from_triple((*box)[0]), from_triple((*box)[1]));
}

py::object approximate_volume_of(const Polyhedron& a, unsigned threads) {
  const MeasuredVolume found = call(
      items(a), [a, threads](const Monitor& monitor) { return approximate_volume(a, monitor.on_threads(threads)); });
  return result_of("Measured", py::make_tuple(found.value, found.error));
}

py::object approximate_area_of(const Polyhedron& a, unsigned threads) {
  const MeasuredArea found =
      call(items(a), [a, threads](const Monitor& monitor) { return approximate_area(a, monitor.on_threads(threads)); });
  return result_of("Measured", py::make_tuple(found.value, found.error));
}

py::object approximate_moments_of(const Polyhedron& a) {
  const std::optional<MeasuredMoments> found =
      call(items(a), [a](const Monitor& monitor) { return approximate_moments(a, monitor); });
  if (!found) return py::none();
  return result_of(
      "ApproximateMoments",
      py::make_tuple(py::make_tuple(found->centroid[0], found->centroid[1], found->centroid[2]), found->centroid_error,
                     floats_of(found->inertia), found->inertia_error,
                     py::array_t<double>(3, found->principal.moments.data()), floats_of(found->principal.axes)));
}

// The report as Python's own parser reads it.
py::object info_of(const Polyhedron& a, bool exact) {
  const std::string text = call(
      items(a), [=](const Monitor& monitor) { return set_info(a, {.exact = exact, .moments = true}, monitor).dump(); });
  return py::module_::import("json").attr("loads")(text);
}

}  // namespace

void bind_measures(py::module_& /*module*/, PolyhedronClass& c) {
  c.def(
       "volume",
       [](const Polyhedron& a) { return optional_fraction(call(items(a), [a](const Monitor&) { return volume(a); })); },
       "The volume, a Fraction; None if it is infinite. Its digits, and the time, grow with the set: "
       "approximate_volume is fast.")
      .def(
          "surface_area",
          [](const Polyhedron& a) { return call(items(a), [a](const Monitor&) { return surface_area(a); }); },
          "The area of the facets, each once, as a float; infinite if one is unbounded.")
      .def("approximate_volume", &approximate_volume_of, py::arg("threads") = 1,
           "The volume as floats: nef.Measured(value, error), off by at most `error`. O(n). threads: 0 for as many as "
           "the "
           "machine has.")
      .def("approximate_area", &approximate_area_of, py::arg("threads") = 1,
           "The area of the facets, each once: nef.Measured(value, error), off by at most `error`. O(n).")
      .def("bounding_box", &box_of,
           "Smallest and largest coordinates of the vertices, as two tuples of Fractions; None if there are no "
           "vertices.")
      .def("moments", &moments_of,
           "Exact volume, centroid and inertia of the solid of density one: nef.Moments; None if the volume is "
           "infinite. The time grows as that of volume; see approximate_moments.")
      .def("approximate_moments", &approximate_moments_of,
           "Centroid and inertia in floats with bounds: nef.ApproximateMoments; None if the volume is infinite or may "
           "be "
           "zero. O(n).")
      .def("info", &info_of, py::arg("exact") = false,
           R"(The report of `nef info --json` as a dictionary with the same keys (docs/reports.md).

Exact numbers are text. exact: compute them however long they are and however long that takes; otherwise measures of all
but small sets are floats with bounds.)");
}

}  // namespace nef::python
