// SPDX-License-Identifier: Apache-2.0
//
// Expressions set by set, for those who keep some of the sets.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/program/expression/expression.h"
#include "nef/tiles/step_sequence.h"

namespace nef {

struct SyntaxNode;

/// A text as steps: `A - B + C` is the set A, from which B is taken away, with which C is united. Each set is made only
/// when it is asked for, so who has kept A - B begins there.
class ExpressionSteps {
 public:
  /// Parses the text; nothing is computed. Throws ExpressionError.
  explicit ExpressionSteps(std::string text);

  /// How many sets there are: 1 for a text without operators outside of parentheses and functions.
  [[nodiscard]] std::size_t size() const;
  /// What joins set i - 1 to set i, i > 0.
  [[nodiscard]] BooleanOperator operation(std::size_t i) const;
  /// The same text for sets that are made alike, in whatever text they stand, and for no others. Files count by name.
  [[nodiscard]] std::string key(std::size_t i) const;
  /// The paths of the files that a set is made of, as they stand in the text.
  [[nodiscard]] std::vector<std::string> files(std::size_t i) const;
  /// Whether a set is made of variables.
  [[nodiscard]] bool has_variables(std::size_t i) const;
  /// Makes a set; variables are made once for all sets. Throws what evaluate_expression does.
  [[nodiscard]] Polyhedron set(std::size_t i, const ExpressionOptions& options = {});
  /// The set of the whole text from all its sets, as evaluate_expression makes it.
  [[nodiscard]] Polyhedron combined(std::span<const Polyhedron> sets, const ExpressionOptions& options = {}) const;

 private:
  [[nodiscard]] const SyntaxNode& node(std::size_t i) const;

  std::string text_;
  std::shared_ptr<const SyntaxNode> tree_;
  const SyntaxNode* block_ = nullptr;                 // in the tree: whose variables there are
  const SyntaxNode* root_ = nullptr;                  // in the tree: the set itself
  std::vector<std::optional<Polyhedron>> variables_;  // that were made
};

}  // namespace nef
