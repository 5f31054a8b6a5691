// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of solids by their reduced convolution: hulls of points on a small grid, united, subtracted and
// regularized, so concave, of several components, with tunnels, cavities and facets in common planes; then sheared, and
// one of them by next to nothing, so that doubles can not tell. Half of them keep what marks the steps give to their
// boundary, points that are missing inside, and passages as narrow as what passes; some are a block with a tunnel of
// boxes, open or closed, exactly as wide as the cube that is added. x is in A + B iff A meets x - B, and the sum of the
// cells is the same set.
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
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

Solid without_flat_pieces(Solid solid) {
  solid.text = "(" + solid.text + " * regularize(" + solid.text + "))";
  solid.set = intersect(solid.set, regularize(solid.set));
  return solid;
}

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
  return without_flat_pieces(std::move(solid));
}

Solid random_box(Choices& choices, const Rational3& low, const Rational3& high) {
  Solid box = {make_box(low, high), "box("};
  for (const Rational3* p : {&low, &high}) {
    for (const Rational& x : *p) box.text += to_string(x) + (p == &high && &x == &p->back() ? ")" : ",");
  }
  if (choices.one_in(2)) return box;
  return {interior(box.set), "interior(" + box.text + ")"};
}

// A block without a chain of boxes whose cross-sections are unit squares.
Solid block_with_tunnel(Choices& choices) {
  Rational3 at{};
  Solid tunnel;
  for (int i = choices.between(2, 4); i > 0; --i) {
    const auto axis = static_cast<std::size_t>(choices.between(0, 2));
    Rational3 high = at;
    for (Rational& x : high) x += 1;
    high[axis] += choices.between(0, 2);
    const Solid piece = random_box(choices, at, high);
    tunnel.text = "(" + tunnel.text + " + " + piece.text + ")";
    tunnel.set = unite(tunnel.set, piece.set);
    at[axis] = high[axis] - choices.between(0, 1);  // the next one begins beside the end, or in it
  }
  const Solid block = random_box(choices, {-2, -2, -2}, {12, 12, 12});
  return without_flat_pieces({subtract(block.set, tunnel.set), "(" + block.text + " - " + tunnel.text + ")"});
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
  const bool tunnel = choices.one_in(4);
  const bool regular = !tunnel && choices.one_in(2);
  const Solid a = tunnel ? block_with_tunnel(choices) : random_solid(choices, choices.between(1, 5), 4, regular);
  const Solid b =
      tunnel ? random_box(choices, {-1, -1, -1}, {0, 0, 0}) : random_solid(choices, choices.between(1, 3), 2, regular);
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
  // The way out of an overlap, from facets near the origin and from the whole sum of cells.
  const Rational3 by = grid_point(choices, 3);
  const Polyhedron placed = transform(second, AffineMap::translate(by));
  const minkowski::Penetration found = minkowski::penetration(first, placed);
  const minkowski::Penetration by_cells = minkowski::penetration(first, placed, options);
  the_case.count(contact_name(found.kind) == "overlapping" ? "ways out" : "apart");
  Case::require(found.kind == by_cells.kind, "penetration: another kind");
  Case::require(found.squared_length == by_cells.squared_length,
                "penetration: moved by point(" + to_string(by[0]) + "," + to_string(by[1]) + "," + to_string(by[2]) +
                    "), squared " + to_string(found.squared_length) + ", by cells " +
                    to_string(by_cells.squared_length));
}

}  // namespace nef::fuzz
