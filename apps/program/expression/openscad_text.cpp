// SPDX-License-Identifier: Apache-2.0
//
// A recursive descent parser for statements, argument lists and values. It keeps the number of its line for messages,
// and bounds the depth of nesting so that no text exhausts the stack.
#include "apps/program/expression/openscad_text.h"

#include <algorithm>
#include <cctype>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef {
namespace {

constexpr std::size_t kDeepestFile = 1000;

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$'; }

class ModelParser {
 public:
  explicit ModelParser(std::string_view text) : text_(text) {}

  OpenScadNode parse() {
    OpenScadNode root;
    root.name = "group";
    while (peek() != '\0') statement(root.children);
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError("line " + std::to_string(line_) + ": " + what);
  }

  // The next character after white space and comments; '\0' at the end.
  char peek() {
    while (at_ < text_.size()) {
      if (text_[at_] == '\n') ++line_;
      if (text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
        line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                     text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at_ = std::min(end + 2, text_.size());
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        ++at_;
      } else {
        return text_[at_];
      }
    }
    return '\0';
  }

  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  void expect(char c) {
    if (take(c)) return;
    fail("expected '" + std::string(1, c) + "', found " +
         (at_ == text_.size() ? "the end" : in_quotes(text_.substr(at_, 1))));
  }

  std::string name() {
    peek();
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  void statement(std::vector<OpenScadNode>& siblings) {
    if (++depth_ > kDeepestFile) fail("the file is nested too deeply");
    bool counts = true;
    for (;;) {
      if (take('%') || take('*')) {
        counts = false;
      } else if (take('!')) {
        fail("the modifier '!' is not supported");
      } else if (!take('#')) {
        break;
      }
    }
    OpenScadNode node;
    node.name = name();
    node.line = line_;
    if (node.name.empty()) fail("expected the name of an object, found " + in_quotes(text_.substr(at_, 1)));
    expect('(');
    if (peek() != ')') {
      do argument(node);
      while (take(','));
    }
    expect(')');
    if (take('{')) {
      while (!take('}')) {
        if (peek() == '\0') fail("'{' of line " + std::to_string(node.line) + " is not closed");
        statement(node.children);
      }
    } else {
      expect(';');
    }
    if (counts) siblings.push_back(std::move(node));
    --depth_;
  }

  void argument(OpenScadNode& node) {
    peek();
    const std::size_t begin = at_;
    std::string key = name();
    if (key.empty() || !take('=')) {
      at_ = begin;
      key.clear();
    }
    node.arguments.emplace_back(std::move(key), value());
  }

  OpenScadValue value() {
    if (++depth_ > kDeepestFile) fail("a list is nested too deeply");
    OpenScadValue result;
    const char c = peek();
    if (take('[')) {
      std::vector<OpenScadValue> list;
      if (peek() != ']') {
        do list.push_back(value());
        while (take(','));
      }
      expect(']');
      result.is = std::move(list);
    } else if (c == '"') {
      result.is = text();
    } else {
      result = word();
    }
    --depth_;
    return result;
  }

  std::string text() {
    std::string result;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      if (text_[at_] == '\n') ++line_;
      result += text_[at_];
    }
    if (at_ == text_.size()) fail("a text has no closing '\"'");
    ++at_;
    return result;
  }

  OpenScadValue word() {
    std::size_t end = at_;
    while (end < text_.size() &&
           (is_name_character(text_[end]) || text_[end] == '.' || text_[end] == '-' || text_[end] == '+')) {
      ++end;
    }
    const std::string_view word = text_.substr(at_, end - at_);
    OpenScadValue result;
    if (word == "true" || word == "false") {
      result.is = word == "true";
    } else if (word != "undef") {
      std::optional<Rational> number = try_parse_rational(word);
      if (!number) {
        fail(word.empty()
                 ? "expected a value, found " + in_quotes(text_.substr(at_, 1))
                 : in_quotes(word) +
                       " is not a number; .csg files have no variables (openscad -o model.csg model.scad writes them)");
      }
      result.is = *std::move(number);
    }
    at_ = end;
    return result;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t depth_ = 0;
};

}  // namespace

const OpenScadValue* OpenScadNode::find(std::string_view argument, std::size_t place) const {
  const OpenScadValue* found = nullptr;
  std::size_t unnamed = 0;
  for (const auto& [name, value] : arguments) {
    if (name == argument || (name.empty() && unnamed == place)) found = &value;
    if (name.empty()) ++unnamed;
  }
  return found == nullptr || std::holds_alternative<std::monostate>(found->is) ? nullptr : found;
}

OpenScadNode parse_openscad(std::string_view text) { return ModelParser(text).parse(); }

}  // namespace nef
