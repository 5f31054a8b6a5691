// SPDX-License-Identifier: Apache-2.0
#include "binding/base/mesh_options.h"

#include "nef/base/error.h"
#include "nef/base/in_quotes.h"

namespace nef::python {
namespace {

Crossings rule_of(const std::string& name) {
  if (const std::optional<Crossings> rule = crossings_of_name(name)) return *rule;
  std::string all;
  for (const Crossings rule : kAllCrossings) all += (all.empty() ? "" : ", ") + std::string(nef::name(rule));
  throw InputError("crossings takes one of " + all + "; not " + in_quotes(name));
}

}  // namespace

MeshOptions mesh_options(const std::string& crossings, double close) {
  if (!(close >= 0 && close <= 100)) {
    throw InputError("close takes the largest share of lids in the area, in percent from 0 to 100; not " +
                     std::to_string(close));
  }
  return {.crossings = rule_of(crossings), .close_percent = close};
}

}  // namespace nef::python
