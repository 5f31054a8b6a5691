// SPDX-License-Identifier: Apache-2.0
#include "apps/program/numbers.h"

#include <cctype>
#include <sstream>

#include "nef/base/counted.h"
#include "nef/base/error.h"

namespace nef {
namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::vector<Rational> parse_numbers(std::string_view text, const std::string& what) {
  std::vector<Rational> result;
  std::size_t at = 0;
  while (at < text.size()) {
    while (at < text.size() && is_space(text[at])) ++at;
    std::size_t end = at;
    while (end < text.size() && text[end] != ',' && !is_space(text[end])) ++end;
    const std::string_view word = text.substr(at, end - at);
    std::optional<Rational> number = try_parse_rational(word);
    if (!number) {
      const std::string within = word == text ? "" : " in '" + std::string(text) + "'";
      throw InputError(what + ": '" + std::string(word) + "'" + within + " is not a number");
    }
    result.push_back(*std::move(number));
    while (end < text.size() && is_space(text[end])) ++end;
    // A comma promises another number.
    if (end < text.size() && text[end] == ',') {
      if (++end == text.size()) throw InputError(what + ": '" + std::string(text) + "' ends with a comma");
    }
    at = end;
  }
  return result;
}

std::vector<Rational> parse_numbers(std::string_view text, std::size_t count, const std::string& what) {
  std::vector<Rational> numbers = parse_numbers(text, what);
  if (numbers.size() != count) {
    throw InputError(what + ": expected " + counted(count, "number", "numbers") +
                     ", separated by commas, instead of '" + std::string(text) + "'");
  }
  return numbers;
}

Rational3 parse_triple(std::string_view text, const std::string& what) {
  const std::vector<Rational> n = parse_numbers(text, what);
  if (n.size() != 3) throw InputError(what + ": expected three numbers x,y,z instead of '" + std::string(text) + "'");
  return {n[0], n[1], n[2]};
}

std::array<Rational, 4> parse_plane(std::string_view text, const std::string& option) {
  const std::string expected = option +
                               ": expected four numbers a,b,c,d, of the plane ax + by + cz + d = 0 (z = 2 is " +
                               "0,0,1,-2), instead of '" + std::string(text) + "'";
  std::vector<Rational> n;
  try {
    n = parse_numbers(text, option);
  } catch (const InputError&) {
    throw InputError(expected);
  }
  if (n.size() != 4) throw InputError(expected);
  return {n[0], n[1], n[2], n[3]};
}

std::vector<NumbersOfLine> parse_lines(const std::string& text, const std::string& file) {
  std::vector<NumbersOfLine> result;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = file + ":" + std::to_string(number);
    result.push_back({where, parse_numbers(line, where)});
  }
  return result;
}

}  // namespace nef
