// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/natural_order.h"

#include <algorithm>
#include <cstddef>

namespace nef::visual_hull {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The digits that a text begins with, which are taken off it.
std::string_view take_digits(std::string_view& text) {
  const auto end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  const std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  return digits;
}

std::string_view without_zeros(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

}  // namespace

bool naturally_before(std::string_view a, std::string_view b) {
  int zeros = 0;  // which has more leading zeros, where that first differs
  while (!a.empty() && !b.empty()) {
    if (!is_digit(a.front()) || !is_digit(b.front())) {
      // As bytes, which is how paths are compared, too.
      const auto x = static_cast<unsigned char>(a.front());
      const auto y = static_cast<unsigned char>(b.front());
      if (x != y) return x < y;
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    const std::string_view whole_a = take_digits(a);
    const std::string_view whole_b = take_digits(b);
    const std::string_view number_a = without_zeros(whole_a);
    const std::string_view number_b = without_zeros(whole_b);
    if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
    if (const int sign = number_a.compare(number_b); sign != 0) return sign < 0;
    if (zeros == 0 && whole_a.size() != whole_b.size()) zeros = whole_a.size() > whole_b.size() ? 1 : -1;
  }
  if (a.empty() != b.empty()) return a.empty();
  return zeros > 0;
}

}  // namespace nef::visual_hull
