// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/scene_number.h"

#include <cmath>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef::visual_hull {
namespace {

[[noreturn]] void too_large(const std::string& where, const std::string& number) {
  throw nef::InputError(where + ": " + number +
                        " is too large: numbers of a scene are at most 1e60 in size; choose "
                        "a larger unit of length");
}

bool is_in_range(const nef::Rational& value) {
  // More bits than 1e60 has, with one to spare for the quotient; doubles tell the rest.
  constexpr std::size_t kBits = 201;
  const std::size_t above = mpz_sizeinbase(value.get_num_mpz_t(), 2);
  const std::size_t below = mpz_sizeinbase(value.get_den_mpz_t(), 2);
  return above <= below + kBits && std::abs(nef::nearest_double(value)) <= kLargestNumber;
}

}  // namespace

void check_size(double value, const std::string& where) {
  if (std::isnan(value)) throw nef::InputError(where + ": a number is not finite");
  if (!(std::abs(value) <= kLargestNumber)) too_large(where, "a number");
}

void check_size(const nef::Rational& value, const std::string& where) {
  if (!is_in_range(value)) too_large(where, "a number");
}

nef::Rational scene_number(std::string_view word, const std::string& where, const std::string& what, Quote quote) {
  const std::string told = quote == Quote::kWord ? nef::in_quotes(word) : "a word";
  std::optional<nef::Rational> value = nef::try_parse_rational(word);
  if (!value) throw nef::InputError(where + ": " + told + " is not a number (" + what + ")");
  if (!is_in_range(*value)) too_large(where, told + " (" + what + ")");
  return *std::move(value);
}

}  // namespace nef::visual_hull
