// SPDX-License-Identifier: Apache-2.0
#include "nef/query/explore.h"

#include <string>

#include "nef/base/error.h"
#include "nef/complex/predicates_of_sets.h"

namespace nef {

Rational3 point(const Polyhedron& a, VertexId vertex) {
  const Complex& c = a.complex();
  if (c.has_box() && is_box_vertex(c, vertex)) {
    throw InputError("vertex " + std::to_string(vertex.index()) + " lies on the infimaximal box");
  }
  return c.points.rational(point_of(vertex));
}

}  // namespace nef
