// SPDX-License-Identifier: Apache-2.0
#include "apps/program/expression/syntax_key.h"

namespace nef {
namespace {

void collect_variables(const SyntaxNode& node, std::set<std::size_t>& variables) {
  if (node.term == Term::kVariable) variables.insert(node.variable);
  for (const SyntaxNode& child : node.sets) collect_variables(child, variables);
}

// Every list begins with its length and every text too, so that no two trees have the same key.
void append_key(const SyntaxNode& node, std::string& key) {
  const auto number = [&key](std::size_t n) { key += std::to_string(n) + ' '; };
  number(static_cast<std::size_t>(node.term));
  number(node.variable);
  number(node.path.size());
  key += node.path;
  number(node.numbers.size());
  for (const Rational& n : node.numbers) key += to_string(n) + ' ';
  number(node.rings.size());
  for (const std::vector<Rational3>& ring : node.rings) {
    number(ring.size());
    for (const Rational3& point : ring) {
      for (const Rational& x : point) key += to_string(x) + ' ';
    }
  }
  number(node.operators.size());
  for (const Term term : node.operators) number(static_cast<std::size_t>(term));
  number(node.sets.size());
  for (const SyntaxNode& child : node.sets) append_key(child, key);
}

}  // namespace

std::set<std::size_t> variables_of(const SyntaxNode& node, const SyntaxNode* block) {
  std::set<std::size_t> variables;
  collect_variables(node, variables);
  // Variables are made of earlier ones only, so one way down from the last one sees all.
  for (auto at = variables.rbegin(); block != nullptr && at != variables.rend(); ++at) {
    collect_variables(block->sets[*at], variables);
  }
  return variables;
}

std::string syntax_key(const SyntaxNode& node, const SyntaxNode* block) {
  std::string key;
  for (const std::size_t i : variables_of(node, block)) {
    key += std::to_string(i) + '=';
    append_key(block->sets[i], key);
  }
  append_key(node, key);
  return key;
}

}  // namespace nef
