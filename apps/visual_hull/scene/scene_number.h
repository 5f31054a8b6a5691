// SPDX-License-Identifier: Apache-2.0
//
// Numbers of a scene: exact, but within the range in which doubles can follow.
#pragma once

#include <string>
#include <string_view>

#include "nef/number/number.h"

namespace nef::visual_hull {

/// No number of a scene may be larger: products of five of them are doubles still, which is what filters and
/// displays multiply.
inline constexpr double kLargestNumber = 1e60;

/// Whether the words of a file may be told: not before it has shown that it is what it was taken for.
enum class Quote : std::uint8_t { kNever, kWord };

/// The number that a word spells. Throws InputError with `where` in front for what is no number or too large; `what`
/// says what the number is ("centre of camera 3").
nef::Rational scene_number(std::string_view word, const std::string& where, const std::string& what,
                           Quote quote = Quote::kWord);

/// Throws InputError with `where` in front if |value| is too large for a scene.
void check_size(const nef::Rational& value, const std::string& where);
void check_size(double value, const std::string& where);

}  // namespace nef::visual_hull
