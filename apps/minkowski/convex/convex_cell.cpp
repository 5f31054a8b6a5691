// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convex/convex_cell.h"

#include <algorithm>
#include <array>

#include "nef/base/error.h"
#include "nef/construct/convex_hull.h"

namespace nef::minkowski {

ConvexCell hull_cell(std::span<const Rational3> points, const Monitor& monitor) {
  Hull hull = hull_of(points, monitor);
  NEF_ASSERT(hull.dimension >= 0);
  ConvexCell cell;
  cell.dimension = hull.dimension;
  cell.mesh = std::move(hull.mesh);
  return cell;
}

ConvexCell translated(const ConvexCell& cell, const Rational3& by) {
  ConvexCell result = cell;
  for (Rational3& p : result.mesh.vertices) {
    for (std::size_t i = 0; i < 3; ++i) p[i] += by[i];
  }
  return result;
}

ConvexCell negated(const ConvexCell& cell) {
  ConvexCell result = cell;
  for (Rational3& p : result.mesh.vertices) {
    for (Rational& x : p) mpq_neg(x.get_mpq_t(), x.get_mpq_t());
  }
  for (Integer3& n : result.normals) {
    for (Integer& x : n) mpz_neg(x.get_mpz_t(), x.get_mpz_t());
  }
  // A reflection turns the surface inside out: run the faces backwards. The edge that started at
  // corner k of n then starts at the corner of its other end.
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
    const auto first = static_cast<std::ptrdiff_t>(result.mesh.face_begin[f]);
    const auto last = static_cast<std::ptrdiff_t>(result.mesh.face_begin[f + 1]);
    std::reverse(result.mesh.corners.begin() + first, result.mesh.corners.begin() + last);
    if (!result.edge_marks.empty())
      std::reverse(result.edge_marks.begin() + first, result.edge_marks.begin() + last - 1);
  }
  return result;
}

ConvexCell opened(ConvexCell cell) {
  if (cell.dimension > 0) cell.boundary = ConvexCell::Boundary::kOpen;
  cell.facet_marks.clear();
  cell.edge_marks.clear();
  cell.vertex_marks.clear();
  return cell;
}

}  // namespace nef::minkowski
