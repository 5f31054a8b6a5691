// SPDX-License-Identifier: Apache-2.0
//
// A recursive descent parser, one function for each rule of the grammar in expression.h.
#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "apps/program/expression/expression.h"
#include "apps/program/expression/functions.h"
#include "apps/program/expression/scanner.h"
#include "apps/program/expression/syntax_tree.h"
#include "apps/program/nearest_word.h"

namespace nef {
namespace {

// Of parentheses and functions in one another. A level takes some 4 KB of the stack under AddressSanitizer, and far
// less otherwise, so half of the usual 8 MB is left for what evaluates the expression.
constexpr std::size_t kDeepestExpression = 1000;

class ExpressionParser : private ExpressionScanner {
 public:
  explicit ExpressionParser(std::string_view text) : ExpressionScanner(text) {}

  SyntaxNode parse() {
    SyntaxNode block;
    block.term = Term::kBlock;
    while (definition(block)) {
    }
    SyntaxNode root = sum();
    if (!block.sets.empty()) {
      block.sets.push_back(std::move(root));
      root = std::move(block);
    }
    if (peek() != '\0') fail("expected an operator (+ * - ^) or the end, found " + here());
    return root;
  }

 private:
  // NAME = a set or a number;
  bool definition(SyntaxNode& block) {
    if (!is_letter(peek())) return false;
    const std::size_t begin = offset();
    const std::string name(word());
    move_to(offset() + name.size());
    if (!take('=')) {
      move_to(begin);
      return false;
    }
    if (find_function(name) != nullptr) {
      move_to(begin);
      fail("'" + name + "' is a reserved word; choose another name");
    }
    if (begins_set()) {
      SyntaxNode set = sum();
      numbers_.erase(name);
      sets_[name] = block.sets.size();
      block.sets.push_back(std::move(set));
    } else {
      Rational value = number("a set or a number");
      sets_.erase(name);
      numbers_[name] = std::move(value);
    }
    if (!take(';')) fail("expected ';' after the value of '" + name + "', found " + here());
    return true;
  }

  // Whether what comes is a set rather than a number or a point: its first word tells, whatever parentheses open
  // before.
  bool begins_set() {
    const std::size_t begin = offset();
    while (take('(')) {
    }
    const char c = peek();
    const bool set = c == '!' || (is_letter(c) && !numbers_.contains(std::string(word())));
    move_to(begin);
    return set;
  }

  // All operators associate (A - B - C is A without B and C), so chains and parentheses of one operator
  // become one node with many operands.
  static SyntaxNode join(Term term, std::size_t offset, SyntaxNode&& left, SyntaxNode&& right) {
    if (left.term == term) {
      left.sets.push_back(std::move(right));
      return std::move(left);
    }
    SyntaxNode node;
    node.term = term;
    node.offset = offset;
    node.sets.push_back(std::move(left));
    node.sets.push_back(std::move(right));
    return node;
  }

  // A run of one operator is one node; different ones make a flat chain, so that long texts make no deep trees.
  SyntaxNode sum() {
    SyntaxNode left = product();
    for (;;) {
      peek();
      const std::size_t begin = offset();
      const Term term = take('+')   ? Term::kUnion
                        : take('-') ? Term::kDifference
                        : take('^') ? Term::kSymmetricDifference
                                    : Term::kNothing;
      if (term == Term::kNothing) return left;
      const bool fresh = left.term != Term::kUnion && left.term != Term::kDifference &&
                         left.term != Term::kSymmetricDifference && left.term != Term::kChain;
      if (fresh || left.term == term) {
        left = join(term, begin, std::move(left), product());
      } else {
        left = lengthen(term, begin, std::move(left), product());
      }
    }
  }

  static SyntaxNode lengthen(Term term, std::size_t offset, SyntaxNode&& left, SyntaxNode&& right) {
    if (left.term != Term::kChain) {
      SyntaxNode chain;
      chain.term = Term::kChain;
      chain.offset = offset;
      chain.sets.push_back(std::move(left));
      left = std::move(chain);
    }
    left.operators.push_back(term);
    left.sets.push_back(std::move(right));
    return std::move(left);
  }

  SyntaxNode product() {
    SyntaxNode left = factor();
    for (;;) {
      peek();
      const std::size_t begin = offset();
      if (!take('*')) return left;
      left = join(Term::kIntersection, begin, std::move(left), factor());
    }
  }

  SyntaxNode factor() {
    if (++depth_ > kDeepestExpression) fail("the expression is nested too deeply");
    const char c = peek();
    const std::size_t begin = offset();
    SyntaxNode node;
    if (take('!')) {
      node.term = Term::kComplement;
      node.offset = begin;
      node.sets.push_back(factor());
    } else if (take('(')) {
      node = sum();
      if (!take(')')) fail("expected ')' for the '(' at " + place_in_text(text(), begin) + ", found " + here());
    } else if (is_letter(c)) {
      node = primary();
    } else {
      fail("expected a set, found " + here() + (c == '[' ? "; the set comes first, as in translate(A, 1,2,3)" : ""));
    }
    --depth_;
    return node;
  }

  SyntaxNode primary() {
    const std::size_t begin = offset();
    const std::string_view name = word();
    if (const auto known = sets_.find(std::string(name)); known != sets_.end()) {
      move_to(offset() + name.size());
      SyntaxNode node;
      node.term = Term::kVariable;
      node.offset = begin;
      node.variable = known->second;
      return node;
    }
    const Function* function = find_function(name);
    if (function == nullptr) fail("there is no set or function '" + std::string(name) + "'" + suggestion(name));
    move_to(offset() + name.size());
    SyntaxNode node;
    node.term = function->term;
    node.offset = begin;
    if (function->shape == ArgumentShape::kBare) return node;
    expect('(', function->usage);
    arguments(*function, node);
    if (peek() == ',') fail("too many arguments; usage: " + std::string(function->usage));
    expect(')', function->usage);
    return node;
  }

  // What other programs call what is written otherwise here.
  static constexpr std::pair<const char*, const char*> kOtherNames[] = {
      {"cube", "a cube is box(0,0,0, 1,1,1)"},
      {"cone", "a cone is cylinder(height, radius, 0)"},
      {"extrude", "a prism is minkowski(polygon((0,0,0), (1,0,0), (0,1,0)), segment((0,0,0), (0,0,2)))"},
      {"linear_extrude", "a prism is minkowski(polygon((0,0,0), (1,0,0), (0,1,0)), segment((0,0,0), (0,0,2)))"},
      {"mirror", "scale(A, -1,1,1) mirrors in x"},
      {"offset", "minkowski(A, ball(r, 4)) grows A by r, erode(A, ball(r, 4)) shrinks it"},
  };

  static constexpr const char* kFilesAreNamed = "; a file is named by file(\"part.off\")";

  [[nodiscard]] std::string suggestion(std::string_view name) const {
    std::vector<std::string> known = function_names();
    for (const auto& [variable, index] : sets_) known.push_back(variable);
    for (const auto& [other, hint] : kOtherNames) {
      if (name == other) return "; " + std::string(hint);
    }
    if (name == "read" || name == "load" || name == "import" || name == "open") return kFilesAreNamed;
    const std::string_view next = text().substr(std::min(offset() + name.size(), text().size()));
    if (next.size() > 1 && next[0] == '.' && is_letter(next[1])) return kFilesAreNamed;  // "a.off"
    if (next.size() > 1 && next[0] == '/' && is_letter(next[1])) return kFilesAreNamed;  // "models/a.off"
    const bool is_axis = name == "x" || name == "y" || name == "z";
    if (is_axis && next.substr(0, 1) == ",") return "; the set comes first, as in rotate(A, z, 90)";
    return did_you_mean(name, known);
  }

  void arguments(const Function& function, SyntaxNode& node) {
    switch (function.shape) {
      case ArgumentShape::kBare:
        break;
      case ArgumentShape::kPath:
        node.path = in_quotes(function);
        break;
      case ArgumentShape::kNumbers:
        numbers(function, node);
        break;
      case ArgumentShape::kPoints:
        if (function.term == Term::kHull && begins_set()) {
          node.term = Term::kHullOfSets;
          do node.sets.push_back(sum());
          while (take(','));
          break;
        }
        node.rings.push_back(points(function));
        break;
      case ArgumentShape::kRings:
        do node.rings.push_back(points(function));
        while (take(';'));
        break;
      case ArgumentShape::kSets:
        sets(function, node);
        break;
      case ArgumentShape::kSetAndNumbers:
        node.sets.push_back(sum());
        expect(',', function.usage);
        numbers(function, node);
        break;
      case ArgumentShape::kRotation:
        node.sets.push_back(sum());
        expect(',', function.usage);
        rotation(function, node);
    }
  }

  void sets(const Function& function, SyntaxNode& node) {
    if (peek() == ')') {
      if (function.least > 0) fail("expected a set; usage: " + std::string(function.usage));
      return;
    }
    do {
      if (node.sets.size() == function.most) fail("too many arguments; usage: " + std::string(function.usage));
      node.sets.push_back(sum());
    } while (take(','));
    if (node.sets.size() < function.least) fail("expected another set; usage: " + std::string(function.usage));
  }

  std::string in_quotes(const Function& function) {
    expect('"', function.usage);
    const std::size_t end = text().find('"', offset());
    if (end == std::string_view::npos) fail("the path has no closing '\"'");
    std::string path(text().substr(offset(), end - offset()));
    if (path.empty()) fail("the path is empty");
    move_to(end + 1);
    return path;
  }

  Rational number(const Function& function) { return number(function.usage); }

  // Sums and products of numbers.
  Rational number(std::string_view usage) {
    Rational value = number_product(usage);
    for (;;) {
      if (take('+')) {
        value += number_product(usage);
      } else if (take('-')) {
        value -= number_product(usage);
      } else {
        return value;
      }
    }
  }

  Rational number_product(std::string_view usage) {
    Rational value = number_factor(usage);
    for (;;) {
      peek();
      const std::size_t begin = offset();
      if (take('*')) {
        value *= number_factor(usage);
      } else if (take('/')) {
        const Rational divisor = number_factor(usage);
        if (divisor == 0) {
          move_to(begin);
          fail("division by zero; usage: " + std::string(usage));
        }
        value /= divisor;
      } else {
        return value;
      }
    }
  }

  Rational number_factor(std::string_view usage) {
    if (++depth_ > kDeepestExpression) fail("the expression is nested too deeply");
    Rational value;
    if (take('(')) {
      value = number(usage);
      if (!take(')')) fail("expected ')', found " + here() + "; usage: " + std::string(usage));
    } else if (take('-')) {
      value = -number_factor(usage);
    } else if (take('+')) {
      value = number_factor(usage);
    } else {
      value = literal(usage);
    }
    --depth_;
    return value;
  }

  Rational literal(std::string_view usage) {
    if (is_letter(peek())) {
      const auto known = numbers_.find(std::string(word()));
      if (known != numbers_.end()) {
        move_to(offset() + known->first.size());
        return known->second;
      }
    }
    // Up to what cannot belong to a number; a sign does after an 'e'.
    const std::string_view rest = text().substr(offset());
    const bool digit_first =
        !rest.empty() && (std::isdigit(static_cast<unsigned char>(rest.front())) != 0 || rest.front() == '.');
    bool fraction = false;
    std::size_t end = 0;
    while (end < rest.size() && std::string_view(",();[]*#").find(rest[end]) == std::string_view::npos &&
           std::isspace(static_cast<unsigned char>(rest[end])) == 0) {
      const char c = rest[end];
      const bool exponent = digit_first && end > 0 && (rest[end - 1] == 'e' || rest[end - 1] == 'E');
      if ((c == '+' || c == '-') && !exponent) break;
      if (c == '/' && (fraction || !fraction_follows(rest.substr(end)))) break;
      fraction = fraction || c == '/';
      ++end;
    }
    const std::string_view digits = rest.substr(0, end);
    if (digits.empty()) fail("expected a number, found " + here() + "; usage: " + std::string(usage));
    std::optional<Rational> value = try_parse_rational(digits);
    if (!value) fail("'" + std::string(digits) + "' is not a number; usage: " + std::string(usage));
    move_to(offset() + end);
    return *std::move(value);
  }

  // Whether a digit comes after the slash: p/q is one number.
  static bool fraction_follows(std::string_view slash) {
    return slash.size() > 1 && std::isdigit(static_cast<unsigned char>(slash[1])) != 0;
  }

  void numbers(const Function& function, SyntaxNode& node) {
    do {
      const bool bracketed = take('[');
      do {
        if (node.numbers.size() == function.most) fail("too many numbers; usage: " + std::string(function.usage));
        node.numbers.push_back(number(function));
      } while (bracketed && take(','));
      if (bracketed) expect(']', function.usage);
    } while (take(','));
    const std::size_t count = node.numbers.size();
    // A scale has one number or three, a matrix twelve or sixteen.
    const bool between = count > function.least && count < function.most &&
                         (function.term == Term::kScale || function.term == Term::kTransform);
    if (count < function.least || between) {
      fail("expected another number, found " + here() + "; usage: " + std::string(function.usage));
    }
  }

  std::vector<Rational3> points(const Function& function) {
    std::vector<Rational3> result;
    if (function.least == 0 && peek() == ')') return result;
    do {
      if (result.size() == function.most) fail("too many numbers; usage: " + std::string(function.usage));
      Rational3 point;
      const bool bracketed = take('[');
      const bool parenthesized = !bracketed && take('(');
      for (std::size_t i = 0; i < 3; ++i) {
        if (i > 0) expect(',', "three numbers for each point");
        point[i] = number(function);
      }
      if (parenthesized) expect(')', "(x,y,z)");
      if (bracketed) expect(']', "[x,y,z]");
      result.push_back(std::move(point));
    } while (take(','));
    if (result.size() < function.least) {
      fail("expected another point, found " + here() + "; usage: " + std::string(function.usage));
    }
    return result;
  }

  void rotation(const Function& function, SyntaxNode& node) {
    const char c = peek();
    if (c == 'x' || c == 'y' || c == 'z') {
      move_to(offset() + 1);
      for (const char axis : {'x', 'y', 'z'}) node.numbers.emplace_back(c == axis ? 1 : 0);
    } else if (c == '(' || c == '[') {
      move_to(offset() + 1);
      for (std::size_t i = 0; i < 3; ++i) {
        if (i > 0) expect(',', "(a,b,c)");
        node.numbers.push_back(number(function));
      }
      expect(c == '(' ? ')' : ']', "(a,b,c)");
    } else {
      fail("expected an axis x, y, z or (a,b,c), found " + here());
    }
    expect(',', function.usage);
    numbers(function, node);
  }

  std::size_t depth_ = 0;
  std::map<std::string, Rational> numbers_;  // variables
  std::map<std::string, std::size_t> sets_;  // variables: which set of the block
};

}  // namespace

SyntaxNode parse_expression(std::string_view text) { return ExpressionParser(text).parse(); }

}  // namespace nef
