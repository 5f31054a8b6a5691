// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/program/expression/expression.h"
#include "nef/tiles/step_sequence.h"

namespace nef {

/// One line of a file of steps.
struct BooleanStep {
  std::size_t line = 0;  ///< counted from 1
  BooleanOperator op = BooleanOperator::kUnion;
  char symbol = '+';
  std::string expression;  ///< with blanks in place of the operator, so that columns are those of the line
};

/// The steps of a file: one operator (+ union, - difference, * intersection, ^ symmetric difference) and one expression
/// a line; empty lines and comments from '#' on are left out. `path` is for messages. All expressions are parsed.
/// Throws FileError naming the line.
std::vector<BooleanStep> parse_steps(std::string_view text, const std::string& path);

/// The set of a step. Errors tell of the path and the line.
Polyhedron operand_of(const BooleanStep& step, const std::string& path, const ExpressionOptions& options);

}  // namespace nef
