// SPDX-License-Identifier: Apache-2.0
//
// Rows of points and planes, whether doubles tell their integers or not.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "nef/base/ranked_bits.h"
#include "nef/geometry/rows/plane_rows.h"
#include "nef/geometry/rows/point_rows.h"

namespace nef::test {
namespace {

Integer random_row_bits(std::mt19937& random, unsigned bits) {
  Integer value = 0;
  for (unsigned i = 0; i < bits; i += 32) value = (value << 32U) + Integer(static_cast<unsigned long>(random()));
  value >>= (bits + 31) / 32 * 32 - bits;
  return random() % 2 == 0 ? value : Integer(-value);
}

Integer row_power(unsigned long base, unsigned exponent) {
  Integer result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return result;
}

// Coordinates of doubles, of decimals, of arbitrary quotients, and of points that meshes do not have.
std::array<Integer, 7> random_point_row(std::mt19937& random) {
  std::array<Integer, 7> h;
  const unsigned kind = random() % 6;
  constexpr std::array<unsigned, 7> kBits{0, 1, 30, 50, 53, 54, 62};
  for (std::size_t i = 0; i < 3; ++i) h[i] = random_row_bits(random, kBits.at(random() % kBits.size()));
  h[3] = kind == 0   ? Integer(1)
         : kind == 1 ? row_power(2, random() % 60)
         : kind == 2 ? row_power(10, random() % 8)
                     : Integer(abs(random_row_bits(random, kind == 3 ? 8 : 100)) + 1);
  if (kind == 5 && random() % 2 == 0) h[4 + random() % 3] = random_row_bits(random, 20);
  if (random() % 8 == 0) h[random() % 3] = row_power(2, 50 + random() % 8);
  return h;
}

// Normals of doubles and others, with offsets around all limits.
std::array<Integer, 5> random_plane_row(std::mt19937& random) {
  std::array<Integer, 5> n;
  constexpr std::array<unsigned, 8> kBits{0, 1, 20, 48, 53, 54, 64, 130};
  const unsigned long shift = random() % 3 == 0 ? random() % 80 : 0;
  for (std::size_t i = 0; i < 3; ++i)
    n[i] = random_row_bits(random, kBits.at(random() % (random() % 4 == 0 ? 8 : 5))) << shift;
  if (n[0] == 0 && n[1] == 0 && n[2] == 0) n[2] = 1;
  constexpr std::array<unsigned, 9> kOffset{0, 1, 53, 61, 62, 63, 116, 118, 200};
  n[3] = random_row_bits(random, kOffset.at(random() % kOffset.size()));
  if (random() % 4 == 0) n[3] = (n[3] >> 60U) << 60U;
  if (random() % 16 == 0) n[4] = random_row_bits(random, 10);
  return n;
}

template <std::size_t width>
std::array<mpz_srcptr, width> row_views(const std::array<Integer, width>& row) {
  std::array<mpz_srcptr, width> result{};
  for (std::size_t i = 0; i < width; ++i) result[i] = row[i].get_mpz_t();
  return result;
}

// By its words if they are long enough, now and then.
template <typename Rows, std::size_t width>
void push_any_row(Rows& rows, const std::array<Integer, width>& row, bool as_words) {
  const auto fits = [](const Integer& x) { return mpz_sizeinbase(x.get_mpz_t(), 2) <= 126; };
  if (!as_words || !std::all_of(row.begin(), row.end(), fits)) {
    rows.push(row_views(row));
    return;
  }
  std::array<Int128, width> words;
  for (std::size_t i = 0; i < width; ++i) {
    const Integer high = abs(row[i]) >> 64U;
    const Integer low = abs(row[i]) & Integer(~0UL);
    words[i] = static_cast<Int128>(static_cast<Unsigned128>(high.get_ui()) << 64U | low.get_ui());
    if (row[i] < 0) words[i] = -words[i];
  }
  rows.push(words);
}

template <typename Rows, std::size_t width>
void check_any_row(const Rows& rows, std::uint32_t row, const std::array<Integer, width>& expected) {
  bool is_small = true;
  for (std::size_t i = 0; i < width; ++i) {
    REQUIRE(mpz_cmp(rows.at(row, i), expected[i].get_mpz_t()) == 0);
    REQUIRE(rows.sign(row, i) == sgn(expected[i]));
    is_small = is_small && abs(expected[i]) < (Integer(1) << 62U);
  }
  std::array<std::int64_t, width> small{};
  REQUIRE(rows.read_small(row, small) == is_small);
  for (std::size_t i = 0; is_small && i < width; ++i) REQUIRE(small[i] == expected[i].get_si());
}

// Copies of rows, one by one and many at once, in tables that hold others already, are the same rows.
template <typename Rows, std::size_t width>
void check_row_copies(const Rows& rows, const std::vector<std::array<Integer, width>>& expected, std::mt19937& random) {
  Rows one_by_one;
  Rows at_once;
  std::vector<std::uint32_t> from;
  for (int i = 0; i < 20; ++i) {
    const auto first = static_cast<std::uint32_t>(random() % expected.size());
    const auto count = static_cast<std::uint32_t>(random() % (expected.size() - first));
    at_once.append(rows, first, count);
    for (std::uint32_t row = first; row < first + count; ++row) {
      one_by_one.push_from(rows, row);
      from.push_back(row);
      if (random() % 10 != 0) continue;
      one_by_one.push_from(rows, 0);
      one_by_one.pop();
    }
  }
  REQUIRE(one_by_one.size() == from.size());
  REQUIRE(at_once.size() == from.size());
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    check_any_row(one_by_one, i, expected[from[i]]);
    check_any_row(at_once, i, expected[from[i]]);
    REQUIRE(one_by_one.approximate(i) == rows.approximate(from[i]));
    REQUIRE(at_once.equal(i, rows, from[i]));
    REQUIRE(one_by_one.hash(i) == rows.hash(from[i]));
  }
}

}  // namespace

TEST_CASE("bits know how many are set before each") {
  std::mt19937 random(5);
  RankedBits bits;
  std::vector<bool> expected;
  const auto check = [](const RankedBits& some, const std::vector<bool>& all, std::size_t first) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
      REQUIRE(some.rank(i) == before);
      REQUIRE(some[i] == all[first + i]);
      before += some[i] ? 1 : 0;
    }
    REQUIRE(some.rank(some.size()) == before);
    REQUIRE(some.count() == before);
  };
  for (int i = 0; i < 1000; ++i) {
    const bool bit = random() % (i < 300 ? 100 : 3) == 0;
    bits.push_back(bit);
    expected.push_back(bit);
    if (random() % 7 != 0) continue;
    bits.pop_back();
    expected.pop_back();
  }
  check(bits, expected, 0);
  for (const std::size_t first : {0U, 1U, 63U, 64U, 100U}) {
    RankedBits part;
    for (std::size_t i = first; i < bits.size();) {
      const std::size_t count = std::min<std::size_t>(random() % 150, bits.size() - i);
      part.append(bits, i, count);
      i += count;
    }
    check(part, expected, first);
  }
}

TEST_CASE("rows of points give back what was pushed, and doubles near it") {
  std::mt19937 random(7);
  for (const int count : {3, 2000}) {
    PointRows rows;
    std::vector<std::array<Integer, 7>> expected;
    for (int i = 0; i < count; ++i) {
      expected.push_back(random_point_row(random));
      push_any_row(rows, expected.back(), random() % 2 == 0);
    }
    REQUIRE(rows.size() == expected.size());
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      const std::array<Integer, 7>& h = expected[i];
      check_any_row(rows, i, h);
      const std::array<IntegerView, 4> coordinates = rows.coordinates(i);
      for (std::size_t k = 0; k < 4; ++k) REQUIRE(mpz_cmp(coordinates[k], h[k].get_mpz_t()) == 0);
      REQUIRE(rows.are_integers(i) == (h[3] == 1));
      REQUIRE(rows.is_finite(i) == (h[4] == 0 && h[5] == 0 && h[6] == 0));
      const Integer most = Integer(1) << 53U;
      const bool doubles = std::all_of(h.begin(), h.end(), [&](const Integer& x) { return abs(x) <= most; });
      REQUIRE(rows.are_doubles(i) == doubles);
      for (std::size_t k = 0; k < 3; ++k) {
        const double near = rows.approximate(i)[k];
        if (h[4 + k] != 0) {
          REQUIRE(near == (h[4 + k] > 0 ? HUGE_VAL : -HUGE_VAL));
          continue;
        }
        Rational exact(h[k], h[3]);
        exact.canonicalize();
        REQUIRE(abs(Rational(near) - exact) * Rational(Integer(1) << 51U) <= abs(exact));
        if (doubles) REQUIRE(near == h[k].get_d() / h[3].get_d());
      }
    }
    check_row_copies(rows, expected, random);
  }
}

TEST_CASE("a point is the same where its denominator has a code and where it has none") {
  PointRows few;
  PointRows many;
  for (long w = 3; w < 300; w += 2) many.push(std::array<Int128, 7>{1, 2, -3, w});
  for (long w = 299; w > 2; w -= 2) few.push(std::array<Int128, 7>{1, 2, -3, w});
  for (std::uint32_t i = 0; i < few.size(); ++i) {
    const auto same = static_cast<std::uint32_t>(few.size() - 1 - i);
    CHECK(few.equal(i, many, same));
    CHECK(few.hash(i) == many.hash(same));
    CHECK(few.approximate(i) == many.approximate(same));
    CHECK_FALSE(few.equal(i, many, (same + 1) % static_cast<std::uint32_t>(many.size())));
  }
  PointRows both;
  both.append(few, 10, 100);
  both.append(many, 20, 90);
  for (std::uint32_t i = 0; i < 100; ++i) CHECK(both.equal(i, few, 10 + i));
  for (std::uint32_t i = 0; i < 90; ++i) CHECK(both.equal(100 + i, many, 20 + i));
}

TEST_CASE("rows of planes give back what was pushed, and doubles near it") {
  std::mt19937 random(11);
  for (const int count : {3, 2000}) {
    PlaneRows rows;
    std::vector<std::array<Integer, 5>> expected;
    for (int i = 0; i < count; ++i) {
      expected.push_back(random_plane_row(random));
      push_any_row(rows, expected.back(), random() % 2 == 0);
    }
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      const std::array<Integer, 5>& n = expected[i];
      check_any_row(rows, i, n);
      const std::array<IntegerView, 5> coefficients = rows.coefficients(i);
      std::size_t top = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        REQUIRE(mpz_cmp(coefficients[k], n[k].get_mpz_t()) == 0);
        if (k < 3 && n[k] != 0) top = std::max(top, mpz_sizeinbase(n[k].get_mpz_t(), 2));
      }
      for (std::size_t k = 0; k < (n[4] == 0 ? 4U : 3U); ++k) {
        Rational exact(n[k], row_power(2, static_cast<unsigned>(top)));
        exact.canonicalize();
        REQUIRE(abs(Rational(rows.approximate(i)[k]) - exact) * Rational(Integer(1) << 52U) <= abs(exact));
      }
      PlaneRows other;
      push_any_row(other, n, random() % 2 == 0);
      REQUIRE(rows.equal(i, other, 0));
      REQUIRE(rows.hash(i) == other.hash(0));
      REQUIRE(rows.equal(i, rows, i / 2) == (n == expected[i / 2]));
    }
    check_row_copies(rows, expected, random);
    std::vector<std::uint8_t> used;
    std::vector<std::array<Integer, 5>> kept;
    for (const std::array<Integer, 5>& n : expected) {
      used.push_back(random() % 2 == 0 ? 1 : 0);
      if (used.back() != 0) kept.push_back(n);
    }
    rows.keep(used);
    REQUIRE(rows.size() == kept.size());
    for (std::uint32_t i = 0; i < rows.size(); ++i) check_any_row(rows, i, kept[i]);
  }
}

TEST_CASE("vertices and planes of meshes take little more than their doubles") {
  PointRows points;
  PlaneRows planes;
  constexpr std::size_t kCount = 1024;
  points.reserve(kCount, 0);
  planes.reserve(kCount, 0);
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto k = static_cast<Int128>(i);
    points.push(std::array<Int128, 7>{k << 40U, -k, 7, Int128{1} << (i % 50)});
    planes.push(std::array<Int128, 5>{(k + 1) << 70U, k << 60U, 1 - k, k << 100U | 12345});
  }
  CHECK(points.bytes() <= 26 * kCount);
  CHECK(planes.bytes() <= 42 * kCount);
}

}  // namespace nef::test
