// SPDX-License-Identifier: Apache-2.0
//
// Exact numbers as text for messages: of bounded length, whatever the number.
#pragma once

#include <string>

#include "nef/number/number.h"

namespace nef {

/// The most characters of a number that a message prints exactly.
inline constexpr std::size_t kBriefNumber = 40;

/// A number for people to read: "p/q" or "p" as to_string() gives it if that has at most kBriefNumber characters, else
/// "about D", where D is the nearest double in its shortest decimal form, or has 17 digits and an exponent if the
/// number is beyond the range of doubles. Never longer than kBriefNumber characters, for numbers whose decimal
/// exponent has at most nine digits. For messages and summaries only: what a program reads back is written with
/// to_string(). O(M(n)) for n bits.
std::string brief_text(const Rational& value);
std::string brief_text(const Integer& value);

/// The double with so many digits, however small it is: "1.23e-05".
std::string short_text(double value, int digits);

/// "(x, y, z)", each as above.
std::string brief_text(const Rational3& point);

}  // namespace nef
