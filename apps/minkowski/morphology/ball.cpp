// SPDX-License-Identifier: Apache-2.0
//
// How far a facet is from the centre is the root of a rational; its square is enough to compare, and one integer root,
// rounded the safe way, makes a bound of it.
#include <cmath>
#include <vector>

#include "apps/minkowski/morphology.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/number/brief_text.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

Rational grid(double value) {
  Rational result(Integer(std::lround(std::ldexp(value, 20))), Integer(1) << 20);
  result.canonicalize();
  return result;
}

// The rational point of the unit sphere next to (x, y, z), all >= 0, by stereographic projection
// from (0, 0, -1): (2s, 2t, 1 - s^2 - t^2) / (1 + s^2 + t^2). On the circle z = 0 it is done from (-1, 0),
// so that the point stays there.
Rational3 on_sphere(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  if (z == 0) {
    const Rational t = grid(y / (length + x));
    const Rational w = 1 + t * t;
    return {Rational((1 - t * t) / w), Rational(2 * t / w), Rational(0)};
  }
  const Rational s = grid(x / (length + z));
  const Rational t = grid(y / (length + z));
  const Rational square = s * s + t * t;
  const Rational w = 1 + square;
  return {Rational(2 * s / w), Rational(2 * t / w), Rational((1 - square) / w)};
}

// An octahedron whose edges are split, with every vertex on the sphere.
ConvexCell ball(const Rational& radius, int splits, const Monitor& monitor) {
  if (sgn(radius) <= 0) throw InputError("the radius of a ball must be positive, not " + brief_text(radius));
  if (splits < 1 || splits > 64) {
    throw InputError("a ball has 1 to 64 splits per edge, not " + std::to_string(splits) + " (4 N^2 + 2 vertices)");
  }
  std::vector<Rational3> points;
  for (int i = 0; i <= splits; ++i) {
    for (int j = 0; i + j <= splits; ++j) {
      const int k = splits - i - j;
      const Rational3 p = on_sphere(i, j, k);
      for (int signs = 0; signs < 8; ++signs) {
        Rational3 q;
        for (std::size_t a = 0; a < 3; ++a)
          q[a] = (signs >> a & 1) != 0 ? Rational(-radius * p[a]) : Rational(radius * p[a]);
        points.push_back(q);
      }
    }
  }
  return hull_cell(points, monitor);
}

// The square of the distance of the nearest facet's plane to the origin.
Rational least_squared_distance(const Mesh& mesh) {
  Rational least = -1;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const Rational3& o = mesh.vertices[face[0]];
    const Rational3 n = cross(minus(mesh.vertices[face[1]], o), minus(mesh.vertices[face[2]], o));
    const Rational offset = dot(n, o);
    const Rational square = offset * offset / dot(n, n);
    if (least < 0 || square < least) least = square;
  }
  return least;
}

// The least multiple of 2^-20 whose square is at least x.
Rational root_above(const Rational& x) {
  // x * 2^40, rounded up; then the least integer whose square is at least that.
  Integer scaled = x.get_num();
  scaled <<= 40;
  mpz_cdiv_q(scaled.get_mpz_t(), scaled.get_mpz_t(), x.get_den_mpz_t());
  Integer root;
  Integer rest;
  mpz_sqrtrem(root.get_mpz_t(), rest.get_mpz_t(), scaled.get_mpz_t());
  if (rest != 0) ++root;
  Rational result(root, Integer(1) << 20);
  result.canonicalize();
  return result;
}

}  // namespace

BallApproximation ball_approximation(const Rational& radius, int splits, Side side, const Monitor& monitor) {
  BallApproximation result{ball(radius, splits, monitor), 0};
  const Rational factor = root_above(Rational(radius * radius / least_squared_distance(result.cell.mesh)));
  if (side == Side::kInner) {
    // Facets are at least radius / factor away.
    result.error = radius * (1 - 1 / factor);
    return result;
  }
  for (Rational3& p : result.cell.mesh.vertices) {
    for (Rational& x : p) x *= factor;
  }
  // Vertices are factor * radius away.
  result.error = radius * (factor - 1);
  return result;
}

Polyhedron inner_ball(const Rational& radius, const Rational& splits, const Monitor& monitor) {
  if (splits.get_den() != 1 || splits < 1 || splits > 64) {
    throw InputError("ball(r, n): n must be a whole number from 1 to 64");
  }
  return to_polyhedron(
      ball_approximation(radius, static_cast<int>(splits.get_num().get_si()), Side::kInner, monitor).cell, monitor);
}

}  // namespace nef::minkowski
