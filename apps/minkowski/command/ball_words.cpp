// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/command/ball_words.h"

#include <vector>

#include "apps/program/numbers.h"
#include "nef/base/error.h"
#include "nef/number/brief_text.h"

namespace nef::minkowski {

BallWords parse_ball(const std::string& text, const std::string& option, std::optional<int> splits) {
  const bool has_splits = !splits || text.find(',') != std::string::npos;
  const std::vector<Rational> numbers = parse_numbers(text, has_splits ? 2 : 1, option + (splits ? " R[,N]" : " R,N"));
  BallWords result{numbers[0], splits.value_or(0)};
  if (!has_splits) return result;
  const Rational& n = numbers[1];
  if (n.get_den() != 1 || n < 1 || n > 64) {
    throw InputError(option + " R,N: N must be a whole number from 1 to 64, not " + brief_text(n));
  }
  result.splits = static_cast<int>(n.get_num().get_si());
  return result;
}

}  // namespace nef::minkowski
