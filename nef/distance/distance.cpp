// SPDX-License-Identifier: Apache-2.0
//
// Unbounded sets are cut off far enough away. How far follows from Cramer's rule: the closures are unions of convex
// cells, which planes with integer coefficients below 2^k bound (a vertex without planes counts as the meeting of
// planes w x = n). Of the nearest pairs (p, q) of two cells take one in faces of least dimension. With the tight planes
// N p = d, M q = e of such a pair, it is a solution of
//     N p = d,  M q = e,  p - q + N^T s = 0,  q - p + M^T t = 0
// with at most three planes on each side, any solution of which is as near; so p and q may be taken from a basic
// solution, with twelve unknowns at most. Each of its coordinates is a quotient of two integer determinants whose rows
// have at most five entries below 2^k: by Hadamard at most (sqrt(5) 2^k)^12 < 2^(12k + 14).
#include "nef/distance/distance.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/construct/construct.h"
#include "nef/distance/intersects.h"
#include "nef/distance/nearest_features.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

std::size_t coefficient_bits(const Complex& c) {
  std::size_t bits = 1;
  const auto add = [&bits](mpz_srcptr value) { bits = std::max(bits, mpz_sizeinbase(value, 2)); };
  for (std::uint32_t row = 0; row < c.planes.size(); ++row) {
    for (std::size_t column = 0; column < 4; ++column) add(c.planes.coefficient(PlaneId::of_row(row), column));
  }
  for (const VertexId v : c.vertex_ids()) {
    if (is_box_vertex(c, v)) continue;
    for (std::size_t column = 0; column < 4; ++column) add(c.points.coordinate(point_of(v), column));
  }
  return bits;
}

// A cube that holds a nearest pair of points of any two cells of these complexes, and a point of each cell.
Polyhedron wide_enough(const Complex& a, const Complex& b, const Monitor& monitor) {
  Integer far = 1;
  far <<= 12 * std::max(coefficient_bits(a), coefficient_bits(b)) + 14;
  const Rational r(far);
  return make_box({-r, -r, -r}, {r, r, r}, monitor);
}

// A point of a closed set that is not empty.
Rational3 some_point(const Polyhedron& closed, const Monitor& monitor) {
  const auto first_vertex = [](const Complex& c) -> std::optional<Rational3> {
    for (const VertexId v : c.vertex_ids()) {
      if (!is_box_vertex(c, v)) return c.points.rational(point_of(v));
    }
    return std::nullopt;
  };
  const Complex& c = closed.complex();
  if (std::optional<Rational3> vertex = first_vertex(c)) return *vertex;
  std::optional<Rational3> corner = first_vertex(intersect(closed, wide_enough(c, c, monitor), monitor).complex());
  NEF_ASSERT(corner);
  return *corner;
}

}  // namespace

double Distance::value() const {
  // The root of a double of full precision, also where the square would leave the range of doubles.
  long exponent = 0;
  long below = 0;
  double root = mpz_get_d_2exp(&exponent, squared.get_num_mpz_t());
  root /= mpz_get_d_2exp(&below, squared.get_den_mpz_t());
  exponent -= below;
  if (exponent % 2 != 0) {
    root *= 2;
    --exponent;
  }
  return std::ldexp(std::sqrt(root), static_cast<int>(std::clamp(exponent / 2, -100000L, 100000L)));
}

std::string_view contact_name(Contact contact) {
  switch (contact) {
    case Contact::kDisjoint:
      return "disjoint";
    case Contact::kTouching:
      return "touching";
    case Contact::kOverlapping:
      break;
  }
  return "overlapping";
}

std::optional<Distance> distance(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  if (a.is_empty() || b.is_empty()) return std::nullopt;
  Polyhedron closed_a = a.is_closed() ? a : closure(a, monitor);
  Polyhedron closed_b = b.is_closed() ? b : closure(b, monitor);
  Distance result;
  const bool bounded = closed_a.is_bounded() && closed_b.is_bounded();
  const Rational3 unmoved;
  if (intersects(closed_a, closed_b, unmoved, monitor)) {
    result.contact = intersects(interior(a, monitor), interior(b, monitor), unmoved, monitor) ? Contact::kOverlapping
                                                                                              : Contact::kTouching;
    result.common_point = result.contact == Contact::kOverlapping || intersects(a, b, unmoved, monitor);
    result.on_a = result.on_b = some_point(intersect(closed_a, closed_b, monitor), monitor);
    return result;
  }
  if (!bounded) {
    const Polyhedron cube = wide_enough(closed_a.complex(), closed_b.complex(), monitor);
    closed_a = intersect(closed_a, cube, monitor);
    closed_b = intersect(closed_b, cube, monitor);
  }
  const NearestPair pair = nearest_features(closed_a.complex(), closed_b.complex(), monitor);
  result.squared = pair.squared;
  result.on_a = pair.on_a;
  result.on_b = pair.on_b;
  return result;
}

}  // namespace nef
