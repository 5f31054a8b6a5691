// SPDX-License-Identifier: Apache-2.0
//
// Affine maps with rational entries. A rotation about an axis a is conjugation by the quaternion
// c + s a with integers s and c: exactly orthogonal for any of them, whether or not the length of
// a is rational, and only the angle has to be approximated.
#include "nef/base/error.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/operation/rational_angle.h"
#include "nef/polyhedron.h"

namespace nef {

AffineMap AffineMap::identity() { return scale({1, 1, 1}); }

AffineMap AffineMap::translate(const Rational3& by) {
  AffineMap result = identity();
  result.translation = by;
  return result;
}

AffineMap AffineMap::scale(const Rational3& factors) {
  AffineMap result;
  for (std::size_t i = 0; i < 3; ++i) result.linear[i][i] = factors[i];
  return result;
}

AffineMap AffineMap::rotate(const Rational3& axis, double degrees, double tolerance) {
  if (is_zero(axis)) throw InputError("the axis of a rotation must not be 0,0,0");
  const Integer3 a = primitive(axis);
  const Integer length_square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  const HalfAngle half = rational_half_angle(exact_rational(degrees), exact_rational(tolerance), length_square);
  const Integer& c = half.cosine;
  const Integer& s = half.sine;
  // With v = s a and N = c^2 + v.v:  N R = (c^2 - v.v) I + 2 v v^T + 2 c [v]x.
  const Integer norm = c * c + s * s * length_square;
  const Integer diagonal = c * c - s * s * length_square;
  const Integer twice_square = 2 * s * s;
  const Integer twice_product = 2 * c * s;
  AffineMap result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result.linear[i][i] = Rational(diagonal + twice_square * a[i] * a[i], norm);
    result.linear[i][j] = Rational(twice_square * a[i] * a[j] - twice_product * a[k], norm);
    result.linear[i][k] = Rational(twice_square * a[i] * a[k] + twice_product * a[j], norm);
    for (Rational& entry : result.linear[i]) entry.canonicalize();
  }
  return result;
}

Rational AffineMap::determinant() const {
  const auto& m = linear;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Rational3 AffineMap::operator()(const Rational3& p) const {
  Rational3 result = translation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i] += linear[i][j] * p[j];
  }
  return result;
}

AffineMap AffineMap::after(const AffineMap& first) const {
  AffineMap result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) result.linear[i][j] += linear[i][k] * first.linear[k][j];
    }
  }
  result.translation = (*this)(first.translation);
  return result;
}

}  // namespace nef
