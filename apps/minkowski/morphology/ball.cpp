// SPDX-License-Identifier: Apache-2.0
//
// How far a facet is from the centre is the root of a rational; its square is enough to compare, and one integer root,
// rounded the safe way, makes a bound of it.
#include "apps/minkowski/convex/tools.h"
#include "apps/minkowski/morphology.h"
#include "nef/base/error.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// The square of the distance of the nearest facet's plane to the origin.
Rational least_squared_distance(const Mesh& mesh) {
  Rational least = -1;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const Rational3& o = mesh.vertices[face[0]];
    const Rational3& p = mesh.vertices[face[1]];
    const Rational3& q = mesh.vertices[face[2]];
    Rational3 n;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      n[i] = (p[j] - o[j]) * (q[k] - o[k]) - (p[k] - o[k]) * (q[j] - o[j]);
    }
    const Rational offset = n[0] * o[0] + n[1] * o[1] + n[2] * o[2];
    const Rational square = offset * offset / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
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
