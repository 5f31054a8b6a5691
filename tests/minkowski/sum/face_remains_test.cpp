// SPDX-License-Identifier: Apache-2.0
//
// What cells leave of a face, where rounding has made the face's polygon wind about the plane that cuts it.
#include "apps/minkowski/union/face_remains.h"

#include <array>
#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/convex/convex_cell.h"
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/union/solid_union.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/machine_parts.h"

namespace {

using nef::Double3;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::ConvexCell;

ConvexCell box_cell(int x0, int y0, int z0, int x1, int y1, int z1) {
  std::vector<Rational3> corners;
  for (const int x : {x0, x1}) {
    for (const int y : {y0, y1}) {
      for (const int z : {z0, z1}) corners.push_back({Rational(x), Rational(y), Rational(z)});
    }
  }
  return nef::minkowski::hull_cell(corners);
}

nef::Polyhedron by(nef::minkowski::UnionStrategy strategy, const nef::Polyhedron& a, const nef::Polyhedron& b) {
  nef::minkowski::MinkowskiOptions options;
  options.strategy = strategy;
  return nef::minkowski::minkowski_sum(a, b, options);
}

// A polygon of up to 24 corners, every other one of which is beyond a plane: such a cut has up to 24 changes of side.
TEST_CASE("face remains: a polygon that winds about a plane keeps all that is beyond it") {
  const std::vector<ConvexCell> cells = {box_cell(0, 0, 0, 8, 8, 1), box_cell(-8, -8, -8, 16, 16, 1)};
  const nef::minkowski::RoundedCells rounded(cells);
  nef::minkowski::ExactCells exact(cells, rounded, {});
  const nef::minkowski::PlanesOfCells planes(rounded, exact);  // nobody asked for a plane: no face is flush
  const nef::minkowski::FlushFaces flush(cells, rounded, exact, planes);
  const nef::BoxTree boxes(rounded.boxes());
  for (const std::size_t corners : {4U, 6U, 8U, 14U, 22U, 24U}) {
    nef::minkowski::FaceRemains remains(rounded, flush, boxes);
    std::vector<Double3> ring;
    nef::Box beyond;
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
      const double z = k % 2 == 0 ? 1 + 0x1p-20 : 1 - 0x1p-18;
      ring.push_back({4 + 3 * std::cos(angle), 4 + 3 * std::sin(angle), z});
      if (k % 2 == 0) beyond.add_rounded(ring.back());
    }
    const nef::Box rest = remains.box_of_rest(rounded.first_face(0), ring);
    CHECK(nef::minkowski::box_holds(rest, beyond));
  }
}

// Faces of sums of turned parts that cross at right angles nearly coincide by the dozen.
TEST_CASE("face remains: sums of turned parts are the same by every strategy") {
  const nef::Polyhedron a = nef::from_mesh(nef::test::turned_part(nef::test::kBushing, 4, 0));
  const nef::Polyhedron b = nef::from_mesh(nef::test::turned_part(nef::test::kBushing, 3, 0.013, true));
  std::vector<ConvexCell> sums;
  for (const ConvexCell& c : nef::minkowski::decompose(a)) {
    for (const ConvexCell& d : nef::minkowski::decompose(b)) {
      if (c.dimension == 3 && d.dimension == 3) sums.push_back(convex_sum(c, d));
    }
  }
  const nef::Polyhedron sum = nef::test::valid(nef::minkowski::unite_solids(sums), "sum");  // without a budget
  CHECK(nef::equal(sum, by(nef::minkowski::UnionStrategy::kConvolution, a, b)));
  CHECK(nef::equal(sum, by(nef::minkowski::UnionStrategy::kQueue, a, b)));
}

}  // namespace
