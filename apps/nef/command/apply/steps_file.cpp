// SPDX-License-Identifier: Apache-2.0
#include "apps/nef/command/apply/steps_file.h"

#include <optional>

#include "apps/program/expression/syntax_tree.h"
#include "nef/io/file_bytes.h"

namespace nef {
namespace {

std::optional<BooleanOperator> operator_of(char symbol) {
  switch (symbol) {
    case '+':
      return BooleanOperator::kUnion;
    case '*':
      return BooleanOperator::kIntersection;
    case '-':
      return BooleanOperator::kDifference;
    case '^':
      return BooleanOperator::kSymmetricDifference;
    default:
      return std::nullopt;
  }
}

std::string place(const std::string& path, std::size_t line) { return path + ": line " + std::to_string(line); }

}  // namespace

std::vector<BooleanStep> parse_steps(std::string_view text, const std::string& path) {
  std::vector<BooleanStep> steps;
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view words = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line;
    if (!words.empty() && words.back() == '\r') words.remove_suffix(1);
    const std::size_t first = words.find_first_not_of(" \t");
    if (first == std::string_view::npos || words[first] == '#') continue;
    const std::optional<BooleanOperator> op = operator_of(words[first]);
    if (!op) {
      throw FileError(FileProblem::kSyntax, place(path, line) + ", column " + std::to_string(first + 1) +
                                                ": a step begins with one of the operators + - * ^, not with '" +
                                                words[first] + "'; write, for example, - box(0,0,0, 1,1,1)");
    }
    BooleanStep step{line, *op, words[first], std::string(words)};
    step.expression[first] = ' ';
    try {
      static_cast<void>(parse_expression(step.expression));
    } catch (const ExpressionError& error) {
      throw FileError(FileProblem::kSyntax, place(path, line) + ", " + error.what());
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

Polyhedron operand_of(const BooleanStep& step, const std::string& path, const ExpressionOptions& options) {
  try {
    return evaluate_expression(step.expression, options);
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    throw FileError(FileProblem::kSyntax, place(path, step.line) + ", " + error.what());
  }
}

}  // namespace nef
