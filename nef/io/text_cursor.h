// SPDX-License-Identifier: Apache-2.0
//
// Reads words and numbers from the text of a file and knows the line for error messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"
#include "nef/number/number.h"

namespace nef {

/// Sets `value` to the rational that `text` spells ("0.1" is one tenth, "1/3" is allowed). Returns
/// false if it spells none. Decimals of up to 19 digits cost no GMP division.
bool parse_number(std::string_view text, Rational& value);

/// A position in a text. Words are separated by white space; a comment runs from '#' to the end of its
/// line. The text and the path must outlive the cursor.
class TextCursor {
 public:
  /// A byte order mark at the beginning, as some editors leave, is skipped.
  TextCursor(std::string_view text, const std::string& path)
      : text_(text), path_(path), position_(text.starts_with("\xef\xbb\xbf") ? 3 : 0) {}

  /// The next word in whatever line; empty at the end of the text.
  std::string_view word();
  /// The next word of the current line; empty at its end (the cursor stays in the line).
  std::string_view word_in_line();
  /// Goes to the beginning of the next line.
  void skip_line();
  /// True if nothing but white space and comments is left.
  bool at_end();
  /// True if the rest of the line is empty.
  bool line_done();

  /// The next word as a number. `what` and `index` say what it should be ("coordinate of vertex 12"), and `element`
  /// where it belongs.
  /// Throws FileError (kTruncated, kNotANumber).
  void number(Rational& value, std::string_view what, std::size_t index, FileElement element);
  /// The next word as a count or index. Throws FileError (kTruncated, kSyntax).
  std::int64_t integer(std::string_view what);

  /// Turns one word into a number or index with the same errors.
  void parse(std::string_view word, Rational& value, std::string_view what, std::size_t index,
             FileElement element = {}) const;
  [[nodiscard]] std::int64_t parse_integer(std::string_view word, std::string_view what) const;

  [[noreturn]] void fail(FileProblem problem, const std::string& what, FileElement element = {}) const;

  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(position_); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string_view take();

  std::string_view text_;
  const std::string& path_;
  std::size_t position_;
  std::size_t line_ = 1;
};

}  // namespace nef
