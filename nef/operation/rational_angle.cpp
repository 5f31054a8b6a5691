// SPDX-License-Identifier: Apache-2.0
//
// The tangent T of the half-angle is evaluated in fixed point (integers, scaled by 2^bits) with
// some tens of bits more than the tolerance asks for; then the simplest rational in an interval
// around it, found by continued fractions, is taken. Canny, Donald and Ressler ("A rational
// rotation method for robust geometric algorithms", 1992) showed that this is as good as possible
// up to a constant; the search here is that for the simplest fraction itself.
#include "nef/operation/rational_angle.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/number/floor.h"
#include "nef/number/simplest_between.h"

namespace nef {
namespace {

// Fixed-point numbers: integers that stand for value * 2^-bits.
class FixedPoint {
 public:
  explicit FixedPoint(unsigned long bits) : bits_(bits) {}

  [[nodiscard]] Integer from(const Rational& x) const {
    Integer result = x.get_num() << bits_;
    mpz_fdiv_q(result.get_mpz_t(), result.get_mpz_t(), x.get_den_mpz_t());
    return result;
  }
  [[nodiscard]] Rational to_rational(const Integer& x) const {
    Rational result(x, Integer(1) << bits_);
    result.canonicalize();
    return result;
  }
  [[nodiscard]] Integer times(const Integer& x, const Integer& y) const { return (x * y) >> bits_; }
  [[nodiscard]] Integer over(const Integer& x, const Integer& y) const { return (x << bits_) / y; }

  // Machin: pi = 16 atan(1/5) - 4 atan(1/239).
  [[nodiscard]] Integer pi() const { return 16 * inverse_tangent_of_inverse(5) - 4 * inverse_tangent_of_inverse(239); }

  // By the series of sine and cosine, for x in [0, pi/4].
  [[nodiscard]] Integer tangent(const Integer& x) const {
    const Integer square = times(x, x);
    Integer sine = x;
    Integer cosine = Integer(1) << bits_;
    Integer term = cosine;
    for (unsigned long k = 2; term != 0; k += 2) {
      term = -times(term, square) / static_cast<long>(k * (k - 1));
      cosine += term;
    }
    term = x;
    for (unsigned long k = 3; term != 0; k += 2) {
      term = -times(term, square) / static_cast<long>(k * (k - 1));
      sine += term;
    }
    return over(sine, cosine);
  }

 private:
  [[nodiscard]] Integer inverse_tangent_of_inverse(unsigned long n) const {
    Integer power = (Integer(1) << bits_) / n;
    Integer sum = power;
    const unsigned long square = n * n;
    for (unsigned long k = 3; power != 0; k += 2) {
      power /= square;
      const Integer term = power / k;
      if (k % 4 == 3) {
        sum -= term;
      } else {
        sum += term;
      }
    }
    return sum;
  }

  unsigned long bits_;
};

// Bits of a positive rational before the binary point, negative for small ones; within one.
long magnitude(const Rational& x) {
  return static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2)) -
         static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2));
}

}  // namespace

HalfAngle rational_half_angle(const Rational& degrees, const Rational& tolerance, const Integer& length_square) {
  if (sgn(tolerance) <= 0) throw InputError("the tolerance of a rotation must be positive");
  if (sgn(length_square) <= 0) throw InputError("the axis of a rotation must not be 0,0,0");
  // To [-180, 180], then to [0, 180] by symmetry, then to [0, 90] by the complement of the half.
  Rational angle = degrees - 360 * floor_of((degrees + 180) / 360);
  const bool negative = sgn(angle) < 0;
  if (negative) angle = -angle;
  const bool obtuse = angle > 90;
  if (obtuse) angle = 180 - angle;
  const Rational allowed = std::min(tolerance, Rational(30));
  // The tangent is good to a few units of 2^-bits; with the length multiplied on (or divided off),
  // to 2^-60 of the tolerance.
  const long length_bits = static_cast<long>(mpz_sizeinbase(length_square.get_mpz_t(), 2)) / 2 + 1;
  const auto bits = static_cast<unsigned long>(70 + std::max(0L, -magnitude(allowed)) + 2 * length_bits);
  const FixedPoint fixed(bits);
  const Integer degree = fixed.pi() / 180;
  const Integer half = fixed.times(fixed.from(angle / 2), degree);
  const Rational tangent = fixed.to_rational(fixed.tangent(half));
  // tan' = 1 + tan^2 grows, so the interval up to the tangent's own slope is safe above, and below
  // with the slope at the lower end. A hundredth is left for all roundings.
  const Rational slack = fixed.to_rational(fixed.times(fixed.from(allowed / 2), degree)) * Rational(99, 100);
  const Rational steep = slack * (1 + tangent * tangent);
  const Rational lower_end = tangent - steep;
  const Rational below = sgn(lower_end) > 0 ? Rational(slack * (1 + lower_end * lower_end)) : steep;
  // The axis' length goes off, or onto the reciprocal.
  const Rational length = fixed.to_rational(sqrt(Integer(length_square << (2 * bits))));
  const Rational factor = obtuse ? length : Rational(1 / length);
  const Rational ratio = simplest_between((tangent - below) * factor, (tangent + steep) * factor);
  HalfAngle result{ratio.get_num(), ratio.get_den()};
  if (obtuse) std::swap(result.sine, result.cosine);
  if (negative) result.sine = -result.sine;
  return result;
}

}  // namespace nef
