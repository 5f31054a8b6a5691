// SPDX-License-Identifier: Apache-2.0
//
// An expression as characters and words, with the place of what is read for messages.
#pragma once

#include <string>
#include <string_view>

namespace nef {

/// Whether a word may begin with it.
bool is_letter(char c);

/// "column C" or "line L, column C" of a byte of the text.
std::string place_in_text(std::string_view text, std::size_t offset);

/// Reads a text from its beginning to its end. White space and comments (from # to the end of the line) are skipped
/// before anything is looked at. The text has to outlive it.
class ExpressionScanner {
 public:
  explicit ExpressionScanner(std::string_view text) : text_(text) {}

  /// The next character; '\0' at the end.
  char peek();
  /// Goes over the next character if it is this one.
  bool take(char c);
  /// Goes over this character; fails with the usage if it is not the next one.
  void expect(char c, std::string_view usage);
  /// The word (letters, digits, _) that begins at the place that was looked at.
  [[nodiscard]] std::string_view word() const;
  /// The place that was looked at, and how to return there.
  [[nodiscard]] std::size_t offset() const { return at_; }
  void move_to(std::size_t offset) { at_ = offset; }
  /// All of the text.
  [[nodiscard]] std::string_view text() const { return text_; }

  /// What comes next, for messages: a character or word in quotes, or "the end".
  std::string here();
  /// Throws ExpressionError that names the place of what comes next.
  [[noreturn]] void fail(const std::string& what);

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace nef
