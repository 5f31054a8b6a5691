// SPDX-License-Identifier: Apache-2.0
//
// Exact numbers and points between Python and C++.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "nef/number/number.h"

namespace nef::python {

namespace py = pybind11;

/// The exact value of a Python number: an int, float, Fraction, Decimal, numpy scalar, or text such as "1/3" and "0.1"
/// (one tenth). Throws TypeError for anything else and InputError for what is no finite number.
Rational to_rational(py::handle number);

/// A fractions.Fraction.
py::object to_fraction(const Rational& value);

/// A Python int.
py::object to_int(const Integer& value);

/// Three numbers in a sequence or array. `what` names them in errors: "a point".
Rational3 to_triple(py::handle triple, const char* what);

/// A tuple of three Fractions.
py::tuple from_triple(const Rational3& triple);

/// A list, an array or a generator, to go through. Throws TypeError for anything else; `what` names it there: "points".
py::iterable to_items(py::handle items, const char* what);

/// Two corners of a box, which are three numbers each. Throws InputError for anything else.
std::array<Rational3, 2> to_corners(py::handle box);

/// Points in a row: an array of shape (N, 3) of floats, of integers or of objects, or a sequence of triples.
std::vector<Rational3> to_points(py::handle points, const char* what);

/// The array as doubles of shape (N, 3), if it is an array of floats; converted only if it must be.
using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
std::optional<DoubleArray> as_doubles(py::handle points);

/// Throws InputError unless the array has the shape (N, 3).
void require_rows_of_three(const py::array& array, const char* what);

/// An array of shape (N, 3) of the nearest doubles; or of Fractions.
py::array from_points(const std::vector<Rational3>& points, bool exact);

}  // namespace nef::python
