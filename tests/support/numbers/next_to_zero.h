// SPDX-License-Identifier: Apache-2.0
//
// Places where a filter is easily wrong: things that touch exactly, though none of their coordinates is a double, and
// the same moved apart, or into each other, by next to nothing.
#pragma once

#include <array>
#include <random>

#include "tests/support/numbers/magnitudes.h"

namespace nef::test {

/// Makes random cases; equal seeds make equal ones.
class NextToZero {
 public:
  explicit NextToZero(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  /// A number of about `bits` bits over 1 to 7.
  Rational number(unsigned bits) {
    const auto size = static_cast<long>(random_() % (1UL << bits));
    Rational result(size - (1L << (bits - 1)), static_cast<long>(1 + random_() % 7));
    result.canonicalize();
    return result;
  }
  Rational3 point(unsigned bits) { return {number(bits), number(bits), number(bits)}; }
  /// Strictly between 0 and 1.
  Rational share() {
    Rational result(static_cast<long>(1 + random_() % 996), 997);
    return result;
  }
  /// 0, or 2^-30 to 2^-74 of either sign.
  Rational tiny() {
    const auto kind = random_() % 3;
    const Rational size = power_of_two(-30 - static_cast<long>(random_() % 45));
    return kind == 0 ? Rational(0) : kind == 1 ? size : Rational(-size);
  }
  /// A power of two at which products of doubles may overflow or vanish, or 1.
  Rational magnitude() {
    return random_() % 2 == 0 ? Rational(1) : power_of_two(kFewExponents[random_() % kFewExponents.size()]);
  }

 private:
  std::mt19937_64 random_;
};

inline Rational3 along(const Rational3& from, const Rational3& direction, const Rational& t) {
  return {from[0] + t * direction[0], from[1] + t * direction[1], from[2] + t * direction[2]};
}
inline Rational3 from_to(const Rational3& a, const Rational3& b) { return along(b, a, -1); }

/// Two tetrahedra: a vertex of the second one stands in a facet of the first one, then the second one is moved outward
/// by `shift`, which may be negative, of a vector about as long as the first one.
struct TwoTetrahedra {
  std::array<Rational3, 4> first;
  std::array<Rational3, 4> second;
  Rational shift;
};
inline TwoTetrahedra vertex_on_facet(NextToZero& random) {
  TwoTetrahedra result;
  const unsigned bits = 6 + static_cast<unsigned>(random.below(46));
  Rational3 u;
  Rational3 v;
  Rational3 out;
  Rational determinant;
  do {
    for (Rational3& p : result.first) p = random.point(bits);
    u = from_to(result.first[0], result.first[1]);
    v = from_to(result.first[0], result.first[2]);
    out = from_to(result.first[3], result.first[0]);
    determinant = out[0] * (u[1] * v[2] - u[2] * v[1]) + out[1] * (u[2] * v[0] - u[0] * v[2]) +
                  out[2] * (u[0] * v[1] - u[1] * v[0]);
  } while (determinant == 0);
  const Rational s = random.share();
  const Rational t = random.share() * (1 - s);
  result.shift = random.tiny();
  const Rational3 foot = along(along(along(result.first[0], u, s), v, t), out, result.shift);
  result.second[0] = foot;
  const std::array<std::array<int, 2>, 3> sides{{{1, 0}, {0, 1}, {-1, -1}}};
  for (std::size_t i = 0; i < 3; ++i) {
    result.second[i + 1] =
        along(along(along(foot, out, Rational(1) / 2), u, Rational(sides[i][0]) / 5), v, Rational(sides[i][1]) / 5);
  }
  const Rational scale = random.magnitude();
  for (auto* corners : {&result.first, &result.second}) {
    for (Rational3& p : *corners) p = scaled(p, scale);
  }
  return result;
}

}  // namespace nef::test
