// SPDX-License-Identifier: Apache-2.0
//
// A recursive descent parser, one function for each rule of the grammar in expression.h.
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

#include "nef/program/expression/expression.h"
#include "nef/program/expression/syntax_tree.h"

namespace nef {
namespace {

// How the arguments of a function look.
enum class ArgumentShape : std::uint8_t { kBare, kPath, kNumbers, kPoints, kRings, kSets, kSetAndNumbers, kRotation };

struct Function {
  std::string_view name;
  Term term;
  ArgumentShape shape;
  std::size_t least = 0;  // numbers or sets
  std::size_t most = 0;
  std::string_view usage;
};

constexpr std::size_t kMany = static_cast<std::size_t>(-1);
constexpr std::size_t kDeepestExpression = 2000;

constexpr std::array kFunctions{
    Function{"nothing", Term::kNothing, ArgumentShape::kBare, 0, 0, "nothing"},
    Function{"everything", Term::kEverything, ArgumentShape::kBare, 0, 0, "everything"},
    Function{"file", Term::kFile, ArgumentShape::kPath, 0, 0, "file(\"path\")"},
    Function{"box", Term::kBox, ArgumentShape::kNumbers, 6, 6, "box(x0,y0,z0, x1,y1,z1)"},
    Function{"halfspace", Term::kHalfspace, ArgumentShape::kNumbers, 4, 4, "halfspace(a,b,c,d)"},
    Function{"point", Term::kPoint, ArgumentShape::kPoints, 1, 1, "point(x,y,z)"},
    Function{"segment", Term::kSegment, ArgumentShape::kPoints, 2, 2, "segment(x0,y0,z0, x1,y1,z1)"},
    Function{"hull", Term::kHull, ArgumentShape::kPoints, 0, kMany, "hull(x,y,z, x,y,z, ...) or hull(A, B, ...)"},
    Function{"sphere", Term::kSphere, ArgumentShape::kNumbers, 1, 2, "sphere(r[, corners])"},
    Function{"cylinder", Term::kCylinder, ArgumentShape::kNumbers, 2, 4,
             "cylinder(h, r) or cylinder(h, r0, r1[, corners])"},
    Function{"minkowski", Term::kMinkowski, ArgumentShape::kSets, 2, 2, "minkowski(A, B)"},
    Function{"polygon", Term::kPolygon, ArgumentShape::kRings, 3, kMany, "polygon(x,y,z, x,y,z, x,y,z, ...)"},
    Function{"union", Term::kUnion, ArgumentShape::kSets, 0, kMany, "union(A, B, ...)"},
    Function{"intersection", Term::kIntersection, ArgumentShape::kSets, 0, kMany, "intersection(A, B, ...)"},
    Function{"difference", Term::kDifference, ArgumentShape::kSets, 2, 2, "difference(A, B)"},
    Function{"symdiff", Term::kSymmetricDifference, ArgumentShape::kSets, 2, 2, "symdiff(A, B)"},
    Function{"complement", Term::kComplement, ArgumentShape::kSets, 1, 1, "complement(A)"},
    Function{"interior", Term::kInterior, ArgumentShape::kSets, 1, 1, "interior(A)"},
    Function{"closure", Term::kClosure, ArgumentShape::kSets, 1, 1, "closure(A)"},
    Function{"boundary", Term::kBoundary, ArgumentShape::kSets, 1, 1, "boundary(A)"},
    Function{"exterior", Term::kExterior, ArgumentShape::kSets, 1, 1, "exterior(A)"},
    Function{"regularize", Term::kRegularize, ArgumentShape::kSets, 1, 1, "regularize(A)"},
    Function{"translate", Term::kTranslate, ArgumentShape::kSetAndNumbers, 3, 3, "translate(A, x,y,z)"},
    Function{"scale", Term::kScale, ArgumentShape::kSetAndNumbers, 1, 3, "scale(A, s) or scale(A, sx,sy,sz)"},
    Function{"rotate", Term::kRotate, ArgumentShape::kRotation, 4, 5, "rotate(A, axis, degrees[, tolerance])"},
    Function{"transform", Term::kTransform, ArgumentShape::kSetAndNumbers, 12, 16, "transform(A, 12 or 16 numbers)"},
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class ExpressionParser {
 public:
  explicit ExpressionParser(std::string_view text) : text_(text) {}

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
    const std::size_t offset = at_;
    const std::string name(word());
    at_ += name.size();
    if (!take('=')) {
      at_ = offset;
      return false;
    }
    const auto is_function = [&name](const Function& f) { return f.name == name; };
    if (std::any_of(kFunctions.begin(), kFunctions.end(), is_function)) {
      at_ = offset;
      fail("'" + name + "' is a word of the language; choose another name");
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
    const std::size_t offset = at_;
    while (take('(')) {
    }
    const char c = peek();
    const bool set = c == '!' || (is_letter(c) && !numbers_.contains(std::string(word())));
    at_ = offset;
    return set;
  }

  // A place in the text is skipped over white space and comments before it is looked at.
  char peek() {
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

  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  void expect(char c, std::string_view usage) {
    if (!take(c)) fail("expected '" + std::string(1, c) + "', found " + here() + "; usage: " + std::string(usage));
  }

  std::string here() {
    const char c = peek();
    if (c == '\0') return "the end";
    if (!is_letter(c)) {
      std::size_t end = at_ + 1;  // a whole character, if it is one of several bytes in UTF-8
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xc0U) == 0x80U) ++end;
      return "'" + std::string(text_.substr(at_, end - at_)) + "'";
    }
    return "'" + std::string(word()) + "'";
  }

  [[noreturn]] void fail(const std::string& what) {
    peek();  // to the token that is wrong
    throw ExpressionError(place_in_text(text_, at_) + ": " + what, at_);
  }

  [[nodiscard]] std::string_view word() const {
    std::size_t end = at_;
    while (end < text_.size() && (is_letter(text_[end]) || std::isdigit(static_cast<unsigned char>(text_[end])) != 0)) {
      ++end;
    }
    return text_.substr(at_, end - at_);
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
      const std::size_t offset = at_;
      const Term term = take('+')   ? Term::kUnion
                        : take('-') ? Term::kDifference
                        : take('^') ? Term::kSymmetricDifference
                                    : Term::kNothing;
      if (term == Term::kNothing) return left;
      const bool fresh = left.term != Term::kUnion && left.term != Term::kDifference &&
                         left.term != Term::kSymmetricDifference && left.term != Term::kChain;
      if (fresh || left.term == term) {
        left = join(term, offset, std::move(left), product());
      } else {
        left = lengthen(term, offset, std::move(left), product());
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
      const std::size_t offset = at_;
      if (!take('*')) return left;
      left = join(Term::kIntersection, offset, std::move(left), factor());
    }
  }

  SyntaxNode factor() {
    if (++depth_ > kDeepestExpression) fail("the expression is nested too deeply");
    const char c = peek();
    const std::size_t offset = at_;
    SyntaxNode node;
    if (take('!')) {
      node.term = Term::kComplement;
      node.offset = offset;
      node.sets.push_back(factor());
    } else if (take('(')) {
      node = sum();
      if (!take(')')) fail("expected ')' for the '(' at " + place_in_text(text_, offset) + ", found " + here());
    } else if (is_letter(c)) {
      node = primary();
    } else {
      fail("expected a set, found " + here());
    }
    --depth_;
    return node;
  }

  SyntaxNode primary() {
    const std::size_t offset = at_;
    const std::string_view name = word();
    if (const auto known = sets_.find(std::string(name)); known != sets_.end()) {
      at_ += name.size();
      SyntaxNode node;
      node.term = Term::kVariable;
      node.offset = offset;
      node.variable = known->second;
      return node;
    }
    const auto* function =
        std::find_if(kFunctions.begin(), kFunctions.end(), [name](const Function& f) { return f.name == name; });
    if (function == kFunctions.end()) fail("there is no set or function '" + std::string(name) + "'");
    at_ += name.size();
    SyntaxNode node;
    node.term = function->term;
    node.offset = offset;
    if (function->shape == ArgumentShape::kBare) return node;
    expect('(', function->usage);
    arguments(*function, node);
    if (peek() == ',') fail("too many arguments; usage: " + std::string(function->usage));
    expect(')', function->usage);
    return node;
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
    const std::size_t end = text_.find('"', at_);
    if (end == std::string_view::npos) fail("the path has no closing '\"'");
    std::string path(text_.substr(at_, end - at_));
    if (path.empty()) fail("the path is empty");
    at_ = end + 1;
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
      const std::size_t offset = at_;
      if (take('*')) {
        value *= number_factor(usage);
      } else if (take('/')) {
        const Rational divisor = number_factor(usage);
        if (divisor == 0) {
          at_ = offset;
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
        at_ += known->first.size();
        return known->second;
      }
    }
    // Up to what cannot belong to a number; a sign does after an 'e'.
    const bool digit_first =
        at_ < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.');
    bool fraction = false;
    std::size_t end = at_;
    while (end < text_.size() && std::string_view(",();[]*#").find(text_[end]) == std::string_view::npos &&
           std::isspace(static_cast<unsigned char>(text_[end])) == 0) {
      const char c = text_[end];
      const bool exponent = digit_first && end > at_ && (text_[end - 1] == 'e' || text_[end - 1] == 'E');
      if ((c == '+' || c == '-') && !exponent) break;
      if (c == '/' && (fraction || !fraction_follows(end))) break;
      fraction = fraction || c == '/';
      ++end;
    }
    if (end == at_) fail("expected a number, found " + here() + "; usage: " + std::string(usage));
    const std::string_view digits = text_.substr(at_, end - at_);
    try {
      Rational value = parse_rational(digits);
      at_ = end;
      return value;
    } catch (const InputError&) {
      fail("'" + std::string(digits) + "' is no number; usage: " + std::string(usage));
    }
  }

  // Whether a digit comes after the slash: p/q is one number.
  [[nodiscard]] bool fraction_follows(std::size_t slash) const {
    return slash + 1 < text_.size() && std::isdigit(static_cast<unsigned char>(text_[slash + 1])) != 0;
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
      ++at_;
      for (const char axis : {'x', 'y', 'z'}) node.numbers.emplace_back(c == axis ? 1 : 0);
    } else if (c == '(' || c == '[') {
      ++at_;
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

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
  std::map<std::string, Rational> numbers_;  // variables
  std::map<std::string, std::size_t> sets_;  // variables: which set of the block
};

}  // namespace

SyntaxNode parse_expression(std::string_view text) { return ExpressionParser(text).parse(); }

std::string place_in_text(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n');
  const std::size_t column = begin == std::string_view::npos ? offset + 1 : offset - begin;
  const std::string where = "column " + std::to_string(column);
  return line == 1 ? where : "line " + std::to_string(line) + ", " + where;
}

}  // namespace nef
