// SPDX-License-Identifier: Apache-2.0
//
// Sizes at which products of doubles overflow or vanish: what is true of a set is true of the set scaled by a power of
// two, and all answers at ordinary sizes, where doubles are far from their limits, are known. A power of two changes no
// digit of a double, so a filter goes wrong where its products leave the range of doubles and nowhere else.
#pragma once

#include <array>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::test {

/// Exponents of two: around those at which products of two, three, four and more numbers overflow (2^1024), lose digits
/// (2^-1022) and vanish (2^-1074), and beyond the range of doubles itself.
inline constexpr std::array kExponents{-1400L, -1074L, -1060L, -1030L, -700L, -664L, -535L, -520L, -510L, -357L, -350L,
                                       -340L,  -270L,  -266L,  -262L,  -256L, -215L, -180L, -150L, -120L, -90L,  60L,
                                       85L,    102L,   128L,   150L,   172L,  204L,  215L,  240L,  254L,  257L,  261L,
                                       265L,   268L,   300L,   341L,   342L,  343L,  346L,  350L,  355L,  400L,  512L,
                                       516L,   530L,   664L,   900L,   1015L, 1022L, 1025L, 1400L};

/// Some of these, for what takes long.
inline constexpr std::array kFewExponents{-1074L, -1030L, -520L, -350L, 172L, 342L, 348L, 513L, 530L, 1025L};

inline Rational power_of_two(long exponent) {
  Rational result = 1;
  if (exponent >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

inline Rational3 scaled(const Rational3& p, const Rational& factor) {
  return {p[0] * factor, p[1] * factor, p[2] * factor};
}

inline Mesh scaled(Mesh mesh, const Rational& factor) {
  for (Rational3& p : mesh.vertices) p = scaled(p, factor);
  return mesh;
}

inline Polyhedron scaled(const Polyhedron& set, const Rational& factor) {
  AffineMap map;
  for (std::size_t i = 0; i < 3; ++i) map.linear[i][i] = factor;
  return transform(set, map);
}

}  // namespace nef::test
