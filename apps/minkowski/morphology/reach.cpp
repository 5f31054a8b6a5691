// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/morphology.h"
#include "nef/base/error.h"
#include "nef/number/brief_text.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

Reach reach(const Polyhedron& tool, const Polyhedron& part, const std::optional<Rational3>& from,
            const MinkowskiOptions& options, MinkowskiReport* report) {
  require_bounded(tool, "the tool");
  require_bounded(part, "the part");
  const Polyhedron free = configuration_space(tool, {&part, 1}, std::nullopt, options, report);
  if (from && !contains(free, *from, options.monitor)) {
    throw InputError("the tool overlaps the part at " + brief_text(*from) + ": give a free position");
  }
  Reach result;
  result.positions = component_of(free, from, options.monitor);
  const Polyhedron swept = minkowski_sum(result.positions, closure(tool, options.monitor), options, report);
  const Polyhedron skin = boundary(part, options.monitor);
  result.touched = intersect(skin, swept, options.monitor);
  result.untouched = subtract(skin, swept, options.monitor);
  return result;
}

}  // namespace nef::minkowski
