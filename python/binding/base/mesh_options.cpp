// SPDX-License-Identifier: Apache-2.0
#include "binding/base/mesh_options.h"

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef::python {
namespace {

namespace py = pybind11;

Crossings rule_of(const std::string& name) {
  if (const std::optional<Crossings> rule = crossings_of_name(name)) return *rule;
  std::string all;
  for (const Crossings rule : kAllCrossings) all += (all.empty() ? "" : ", ") + std::string(nef::name(rule));
  throw InputError("crossings takes one of " + all + "; not " + in_quotes(name));
}

double percent_of(py::handle close) {
  constexpr double kUsual = 10;
  if (py::isinstance<py::bool_>(close)) return close.cast<bool>() ? kUsual : 0;
  try {
    const auto percent = close.cast<double>();
    if (percent >= 0 && percent <= 100) return percent;
  } catch (const py::cast_error&) {  // as for a number out of range
  }
  throw InputError("close takes the largest share of lids in the area, in percent from 0 to 100; not " +
                   std::string(py::str(close)));
}

}  // namespace

MeshOptions mesh_options(const std::string& crossings, py::handle close) {
  return {.crossings = rule_of(crossings), .close_percent = percent_of(close)};
}

}  // namespace nef::python
