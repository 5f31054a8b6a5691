// SPDX-License-Identifier: Apache-2.0
//
// Numbers in messages: exact while they are short, never longer than a part of a line.
#include "nef/number/brief_text.h"

#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "nef/number/number.h"

namespace nef {
namespace {

Rational power(const Rational& base, unsigned exponent) {
  Rational result = 1;
  for (unsigned i = 0; i < exponent; ++i) result *= base;
  return result;
}

Rational random_number(int digits) {
  std::string text = *rc::gen::inRange(0, 2) == 0 ? "" : "-";
  text += static_cast<char>('1' + *rc::gen::inRange(0, 9));
  for (int i = 1; i < digits; ++i) text += static_cast<char>('0' + *rc::gen::inRange(0, 10));
  return Rational(Integer(text, 10));
}

TEST_CASE("brief_text: short numbers are exact") {
  CHECK(brief_text(Rational(0)) == "0");
  CHECK(brief_text(Rational(-22, 7)) == "-22/7");
  CHECK(brief_text(Integer(12)) == "12");
  CHECK(brief_text(Rational3{1, Rational(1, 3), -5}) == "(1, 1/3, -5)");
  CHECK(brief_text(Rational(Integer(std::string(40, '9'), 10))) == std::string(40, '9'));
}

TEST_CASE("brief_text: long numbers are the nearest double, in as many digits as that needs") {
  CHECK(brief_text(Rational(Integer(std::string(41, '9'), 10))) == "about 1e+41");
  CHECK(brief_text(Rational((power(10, 300) + 1) / (4 * power(10, 300)))) == "about 0.25");
  CHECK(brief_text(Rational(-(power(10, 300) + 1) / (3 * power(10, 300)))) == "about -0.3333333333333333");
}

TEST_CASE("brief_text: beyond doubles there is an exponent still") {
  CHECK(brief_text(power(10, 400)) == "about 1e+400");
  CHECK(brief_text(Rational(-12345 * power(10, 20000))) == "about -1.2345e+20004");
  CHECK(brief_text(Rational(1 / power(10, 400))) == "about 1e-400");
  CHECK(brief_text(power(Rational(2), 40000)) == "about 1.5842603725730787e+12041");
}

TEST_CASE("brief_text: never long, exact or the nearest double") {
  CHECK(rc::check([] {
    const int digits = *rc::gen::inRange(1, 60);
    const Rational value = random_number(digits) / random_number(*rc::gen::inRange(1, 60));
    const std::string text = brief_text(value);
    RC_ASSERT(text.size() <= kBriefNumber);
    if (text.starts_with("about ")) {
      RC_ASSERT(to_string(value).size() > kBriefNumber);
      RC_ASSERT(std::strtod(text.c_str() + 6, nullptr) == nearest_double(value));
    } else {
      RC_ASSERT(parse_rational(text) == value);
    }
  }));
}

}  // namespace
}  // namespace nef
