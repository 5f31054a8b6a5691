// SPDX-License-Identifier: Apache-2.0
//
// Parts of expressions as texts that tell how they are made, to find them again.
#pragma once

#include <set>
#include <string>

#include "apps/program/expression/syntax_tree.h"

namespace nef {

/// The variables of a block that one of its nodes is made of, those that these are made of included, ascending.
std::set<std::size_t> variables_of(const SyntaxNode& node, const SyntaxNode* block);

/// The same text for nodes that are made alike, wherever they stand, and for no others: files by their names, variables
/// by what they are. `block`: whose variables a node may name; null if there is none.
std::string syntax_key(const SyntaxNode& node, const SyntaxNode* block);

}  // namespace nef
