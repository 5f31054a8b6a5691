// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of solids by their reduced convolution: hulls of points on a small grid, united, subtracted and
// regularized, so concave, of several components, with tunnels, cavities and facets in common planes; then sheared, and
// one of them by next to nothing, so that doubles can not tell. Half of them keep what marks the steps give to their
// boundary, points that are missing inside, and passages as narrow as what passes. x is in A + B iff A meets x - B, and
// the sum of the cells is the same set.
#include "apps/minkowski/minkowski.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/distance/intersects.h"

namespace nef::fuzz {
namespace {

Rational3 grid_point(Choices& choices, int size) {
  Rational3 p;
  for (Rational& x : p) x = choices.between(0, size);
  return p;
}

struct Solid {
  Polyhedron set;
  std::string text = "nothing";
};

Solid random_solid(Choices& choices, int steps, int size, bool regular) {
  Solid solid;
  for (int i = 0; i < steps; ++i) {
    std::vector<Rational3> points;
    if (choices.one_in(2)) {
      for (int k = choices.between(4, 6); k > 0; --k) points.push_back(grid_point(choices, size));
    } else {
      const Rational3 low = grid_point(choices, size - 1);
      Rational3 high = grid_point(choices, size - 1);
      for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + 1 + high[k] / 2;
      for (unsigned k = 0; k < 8; ++k) {
        points.push_back(
            {(k & 1U) != 0 ? high[0] : low[0], (k & 2U) != 0 ? high[1] : low[1], (k & 4U) != 0 ? high[2] : low[2]});
      }
    }
    const bool minus = i > 0 && choices.one_in(3);
    const bool either = !minus && !regular && choices.one_in(4);
    std::string hull = "hull(";
    for (const Rational3& p : points) {
      hull += to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) + (&p == &points.back() ? ")" : ", ");
    }
    Polyhedron piece = convex_hull(points);
    if (!regular && choices.one_in(2)) {
      piece = interior(piece);
      hull = "interior(" + hull + ")";
    }
    solid.text = "(" + solid.text + (minus ? " - " : either ? " ^ " : " + ") + hull + ")";
    solid.set = minus    ? subtract(solid.set, piece)
                : either ? symmetric_difference(solid.set, piece)
                         : unite(solid.set, piece);
    if (!regular) continue;
    solid.text = "regularize" + solid.text;
    solid.set = regularize(solid.set);
  }
  if (regular) return solid;
  if (choices.one_in(3)) {
    solid.text = "interior(closure" + solid.text + ")";
    solid.set = interior(closure(solid.set));
  }
  solid.text = "(" + solid.text + " * regularize(" + solid.text + "))";  // no pieces of dimension 2 and less
  solid.set = intersect(solid.set, regularize(solid.set));
  return solid;
}

AffineMap random_slight_shear(Choices& choices) {
  AffineMap map = AffineMap::identity();
  if (choices.one_in(3)) return map;
  map.linear[0][1] = Rational(choices.between(-2, 2), 3);
  map.linear[1][2] = Rational(choices.between(-2, 2), 7);
  map.linear[2][0] = Rational(choices.between(0, 1));
  for (auto& row : map.linear) {
    for (Rational& x : row) x.canonicalize();
  }
  return map.determinant() == 0 ? AffineMap::identity() : map;
}

}  // namespace

void fuzz_convolutions(const Case& the_case) {
  Choices& choices = the_case.choices();
  const bool regular = choices.one_in(2);
  const Solid a = random_solid(choices, choices.between(1, 5), 4, regular);
  const Solid b = random_solid(choices, choices.between(1, 3), 2, regular);
  the_case.tell("a = " + a.text);
  the_case.tell("b = " + b.text);
  if (a.set.is_empty() || b.set.is_empty()) return;
  const AffineMap map = random_slight_shear(choices);
  AffineMap nearly = map;
  nearly.linear[1][0] += Rational(choices.between(-1, 1), 3) / Rational(Integer(1) << 60U);
  if (nearly.determinant() == 0) return;
  the_case.tell("sheared by [0][1] " + to_string(map.linear[0][1]) + ", [1][2] " + to_string(map.linear[1][2]) +
                ", [2][0] " + to_string(map.linear[2][0]) + "; b by [1][0] " + to_string(nearly.linear[1][0]));
  const Polyhedron first = transform(a.set, map);
  const Polyhedron second = transform(b.set, nearly);
  minkowski::MinkowskiOptions options;
  options.strategy = minkowski::UnionStrategy::kConvolution;
  minkowski::MinkowskiReport report;
  const Polyhedron sum = the_case.valid(minkowski::minkowski_sum(first, second, options, &report), "sum");
  if (regular) Case::require(report.cells_a == 0, "cells: the convolution was given up");
  the_case.count(report.cells_a == 0 ? "by convolution" : "by cells");
  const Polyhedron turned = minkowski::negate(second);
  const IntersectionQuery query(first, turned);
  for (std::uint32_t v = 0; v < sum.complex().vertex_count(); v += 1 + choices.below(4)) {
    Rational3 x = sum.complex().points.rational(PointId{v});
    for (const int k : {0, 1}) {  // on the boundary and beside it
      x[v % 3] += Rational(k) / 5;
      const bool meets = !intersect(first, transform(turned, AffineMap::translate(x))).is_empty();
      the_case.count("points");
      Case::require(query.meet(x) == meets, "intersects: not what the intersection says");
      if (contains(sum, x) == meets) continue;
      Case::require(false, "membership: of point(" + to_string(x[0]) + "," + to_string(x[1]) + "," + to_string(x[2]) +
                               "), want " + (meets ? "inside" : "outside"));
    }
  }
  options.strategy = minkowski::UnionStrategy::kQueue;
  Case::require(equal(sum, minkowski::minkowski_sum(first, second, options)), "cells: another set");
}

}  // namespace nef::fuzz
