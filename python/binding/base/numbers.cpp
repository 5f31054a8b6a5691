// SPDX-License-Identifier: Apache-2.0
//
// Integers of up to a word are converted directly and longer ones by hexadecimal text, which takes linear time. Numbers
// with a numerator and a denominator become quotients, Decimal and numpy's floats by `as_integer_ratio`. Arrays of
// doubles or integers are read as blocks of memory.
#include "binding/base/numbers.h"

#include <cmath>

#include "nef/base/error.h"

namespace nef::python {
namespace {

// Held for good: they are needed until the interpreter ends, and must not be released after it has.
py::handle fraction_type() {
  static const py::handle type = py::object(py::module_::import("fractions").attr("Fraction")).release();
  return type;
}

py::object steal_or_throw(PyObject* object) {
  if (object == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(object);
}

Integer integer_of(py::handle number) {
  int overflow = 0;
  const long small = PyLong_AsLongAndOverflow(number.ptr(), &overflow);
  if (overflow == 0) {
    if (small == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    return small;
  }
  const py::object text = steal_or_throw(PyNumber_ToBase(number.ptr(), 16));
  std::string digits = py::cast<std::string>(text);  // "-0x..."
  digits.erase(digits.find("0x"), 2);
  return Integer(digits, 16);
}

Rational quotient(py::handle numerator, py::handle denominator) {
  Rational result(integer_of(steal_or_throw(PyNumber_Index(numerator.ptr()))),
                  integer_of(steal_or_throw(PyNumber_Index(denominator.ptr()))));
  if (result.get_den() == 0) throw InputError("a fraction with the denominator 0 is not a number");
  result.canonicalize();
  return result;
}

// Writes into the numbers where they are; one made elsewhere would cost two more visits to the allocator.
template <typename T>
std::vector<Rational3> read_rows(const py::array_t<T, py::array::c_style | py::array::forcecast>& array) {
  std::vector<Rational3> points(static_cast<std::size_t>(array.shape(0)));
  const T* in = array.data();
  for (Rational3& point : points) {
    for (Rational& x : point) {
      const T value = *in++;
      if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) throw InputError("a coordinate is not a finite number");
        mpq_set_d(x.get_mpq_t(), value);
      } else {
        mpq_set_si(x.get_mpq_t(), value, 1);
      }
    }
  }
  return points;
}

}  // namespace

Rational to_rational(py::handle number) {
  if (PyFloat_Check(number.ptr())) return exact_rational(PyFloat_AS_DOUBLE(number.ptr()));
  if (PyLong_Check(number.ptr())) return integer_of(number);
  if (PyUnicode_Check(number.ptr())) return parse_rational(py::cast<std::string>(number));
  if (PyIndex_Check(number.ptr())) return integer_of(steal_or_throw(PyNumber_Index(number.ptr())));
  if (py::hasattr(number, "numerator") && py::hasattr(number, "denominator")) {
    return quotient(number.attr("numerator"), number.attr("denominator"));
  }
  if (py::hasattr(number, "as_integer_ratio")) {
    try {
      const py::tuple ratio = number.attr("as_integer_ratio")();
      return quotient(ratio[0], ratio[1]);
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_OverflowError) && !error.matches(PyExc_ValueError)) throw;
      throw InputError(py::cast<std::string>(py::repr(number)) + " is not a finite number");
    }
  }
  throw py::type_error("a number is needed (int, float, Fraction, Decimal or text), not " +
                       std::string(Py_TYPE(number.ptr())->tp_name));
}

py::object to_int(const Integer& value) {
  if (value.fits_slong_p()) return steal_or_throw(PyLong_FromLong(value.get_si()));
  return steal_or_throw(PyLong_FromString(value.get_str(16).c_str(), nullptr, 16));
}

py::object to_fraction(const Rational& value) {
  return fraction_type()(to_int(value.get_num()), to_int(value.get_den()));
}

Rational3 to_triple(py::handle triple, const char* what) {
  Rational3 result;
  // The usual cases without a detour through iterators.
  if (PyTuple_Check(triple.ptr()) && PyTuple_GET_SIZE(triple.ptr()) == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = to_rational(PyTuple_GET_ITEM(triple.ptr(), static_cast<Py_ssize_t>(i)));
    }
    return result;
  }
  if (!PySequence_Check(triple.ptr()) || PyUnicode_Check(triple.ptr()) || PySequence_Size(triple.ptr()) != 3) {
    PyErr_Clear();
    throw InputError(std::string(what) + " needs three numbers, such as (0, 0, 1)");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = to_rational(steal_or_throw(PySequence_GetItem(triple.ptr(), static_cast<Py_ssize_t>(i))));
  }
  return result;
}

py::tuple from_triple(const Rational3& triple) {
  return py::make_tuple(to_fraction(triple[0]), to_fraction(triple[1]), to_fraction(triple[2]));
}

py::iterable to_items(py::handle items, const char* what) {
  if (!py::isinstance<py::iterable>(items)) {
    throw py::type_error(std::string(what) + " must be a list or an array, not " + Py_TYPE(items.ptr())->tp_name);
  }
  return py::reinterpret_borrow<py::iterable>(items);
}

std::array<Rational3, 2> to_corners(py::handle box) {
  std::vector<Rational3> corners;
  for (const py::handle corner : to_items(box, "a box of two corners")) {
    corners.push_back(to_triple(corner, "a corner"));
  }
  if (corners.size() != 2) throw InputError("a box needs two corners, not " + std::to_string(corners.size()));
  return {corners[0], corners[1]};
}

void require_rows_of_three(const py::array& array, const char* what) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  throw InputError(std::string(what) + " must be an array of shape (N, 3), not (" + shape + ")");
}

std::optional<DoubleArray> as_doubles(py::handle points) {
  if (!py::isinstance<py::array>(points)) return std::nullopt;
  const auto array = py::reinterpret_borrow<py::array>(points);
  // Wider floats than double would be rounded; they go through their fractions.
  if (array.dtype().kind() != 'f' || array.itemsize() > 8) return std::nullopt;
  return DoubleArray::ensure(array);
}

std::vector<Rational3> to_points(py::handle points, const char* what) {
  if (const std::optional<DoubleArray> doubles = as_doubles(points)) {
    require_rows_of_three(*doubles, what);
    return read_rows<double>(*doubles);
  }
  if (py::isinstance<py::array>(points)) {
    const auto array = py::reinterpret_borrow<py::array>(points);
    require_rows_of_three(array, what);
    const char kind = array.dtype().kind();
    if (kind == 'i' || (kind == 'u' && array.itemsize() < 8)) {
      using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
      return read_rows<std::int64_t>(Integers::ensure(array));
    }
  }
  std::vector<Rational3> result;
  const std::string each = "each row of " + std::string(what);
  for (const py::handle row : to_items(points, what)) result.push_back(to_triple(row, each.c_str()));
  return result;
}

py::array from_points(const std::vector<Rational3>& points, bool exact) {
  const auto rows = static_cast<py::ssize_t>(points.size());
  if (!exact) {
    py::array_t<double> result({rows, py::ssize_t{3}});
    double* out = result.mutable_data();
    for (const Rational3& p : points) {
      for (const Rational& x : p) *out++ = nearest_double(x);
    }
    return result;
  }
  py::array result(py::dtype("O"), std::vector<py::ssize_t>{rows, 3});
  auto** out = static_cast<PyObject**>(result.mutable_data());
  for (const Rational3& p : points) {
    for (const Rational& x : p) {
      Py_XDECREF(*out);
      *out++ = to_fraction(x).release().ptr();
    }
  }
  return result;
}

}  // namespace nef::python
