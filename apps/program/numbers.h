// SPDX-License-Identifier: Apache-2.0
//
// Lists of exact numbers as people write them on command lines and in text files.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// The numbers of a list separated by commas, spaces or both. Throws InputError that names `what` for anything else.
std::vector<Rational> parse_numbers(std::string_view text, const std::string& what);

/// The same for exactly `count` numbers.
std::vector<Rational> parse_numbers(std::string_view text, std::size_t count, const std::string& what);

/// Three numbers "x,y,z".
Rational3 parse_triple(std::string_view text, const std::string& what);

/// The plane ax + by + cz + d = 0 of the four numbers "a,b,c,d" after an option.
std::array<Rational, 4> parse_plane(std::string_view text, const std::string& option);

/// A line of a text that has numbers, and its place for messages: "file:line".
struct NumbersOfLine {
  std::string where;
  std::vector<Rational> numbers;
};
/// The lines of a file that are not blank, each as parse_numbers reads it.
std::vector<NumbersOfLine> parse_lines(const std::string& text, const std::string& file);

}  // namespace nef
