// SPDX-License-Identifier: Apache-2.0
#include "apps/program/expression/scanner.h"

#include <algorithm>
#include <cctype>

#include "apps/program/expression/expression.h"

namespace nef {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

char ExpressionScanner::peek() {
  while (at_ < text_.size()) {
    if (text_[at_] == '#') {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      ++at_;
    } else {
      return text_[at_];
    }
  }
  return '\0';
}

bool ExpressionScanner::take(char c) {
  if (peek() != c) return false;
  ++at_;
  return true;
}

void ExpressionScanner::expect(char c, std::string_view usage) {
  if (!take(c)) fail("expected '" + std::string(1, c) + "', found " + here() + "; usage: " + std::string(usage));
}

std::string_view ExpressionScanner::word() const {
  std::size_t end = at_;
  while (end < text_.size() && (is_letter(text_[end]) || std::isdigit(static_cast<unsigned char>(text_[end])) != 0)) {
    ++end;
  }
  return text_.substr(at_, end - at_);
}

std::string ExpressionScanner::here() {
  const char c = peek();
  if (c == '\0') return "the end";
  if (is_letter(c)) return "'" + std::string(word()) + "'";
  std::size_t end = at_ + 1;  // a whole character, if it is one of several bytes in UTF-8
  while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xc0U) == 0x80U) ++end;
  return "'" + std::string(text_.substr(at_, end - at_)) + "'";
}

void ExpressionScanner::fail(const std::string& what) {
  peek();  // to what is wrong
  throw ExpressionError(place_in_text(text_, at_) + ": " + what, at_);
}

std::string place_in_text(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n');
  const std::size_t column = begin == std::string_view::npos ? offset + 1 : offset - begin;
  const std::string where = "column " + std::to_string(column);
  return line == 1 ? where : "line " + std::to_string(line) + ", " + where;
}

}  // namespace nef
