// SPDX-License-Identifier: Apache-2.0
//
// Greatest common divisors of machine integers.
#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <cstdint>
#include <numeric>

#include "nef/number/int128.h"

namespace nef {
namespace {

// Numbers of all lengths, zero among them.
std::uint64_t word_of_any_length() {
  const auto value = *rc::gen::resize(1000, rc::gen::arbitrary<std::uint64_t>());
  const int shift = *rc::gen::inRange(0, 65);
  return shift == 64 ? 0 : value << static_cast<unsigned>(shift / 2) >> static_cast<unsigned>(shift);
}

}  // namespace

TEST_CASE("greatest common divisors") {
  CHECK(rc::check("of words", [] {
    const std::uint64_t common = word_of_any_length() & 0xffff;
    const std::uint64_t a = (word_of_any_length() >> 16U) * common;
    const std::uint64_t b = (word_of_any_length() >> 16U) * common;
    RC_ASSERT(greatest_common_divisor(a, b) == std::gcd(a, b));
  }));
  CHECK(rc::check("of a denominator and a number of one or two words", [] {
    const auto denominator = static_cast<std::int64_t>(word_of_any_length() >> 2U) + 1;
    const auto value = static_cast<std::int64_t>(word_of_any_length());
    const Int128 wide = static_cast<Int128>(value) * static_cast<std::int64_t>(word_of_any_length() >> 1U);
    RC_ASSERT(common_divisor(denominator, wide) ==
              std::gcd(denominator, static_cast<std::int64_t>(wide % denominator)));
    if (value != INT64_MIN) RC_ASSERT(common_divisor(denominator, value) == std::gcd(denominator, value));
  }));
  const std::uint64_t last = ~std::uint64_t{0};
  CHECK(greatest_common_divisor(0, 0) == 0);
  CHECK(greatest_common_divisor(0, last) == last);
  CHECK(greatest_common_divisor(last, 0) == last);
  CHECK(greatest_common_divisor(last, last) == last);
  CHECK(greatest_common_divisor(last, last - 1) == 1);
  CHECK(greatest_common_divisor(std::uint64_t{1} << 63U, std::uint64_t{3} << 62U) == std::uint64_t{1} << 62U);
}

}  // namespace nef
