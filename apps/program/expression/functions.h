// SPDX-License-Identifier: Apache-2.0
//
// The words of the language of expressions: which sets and functions there are, and what they take.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/program/expression/syntax_tree.h"

namespace nef {

/// How the arguments of a function look.
enum class ArgumentShape : std::uint8_t { kBare, kPath, kNumbers, kPoints, kRings, kSets, kSetAndNumbers, kRotation };

/// A word of the language.
struct Function {
  std::string_view name;
  Term term;
  ArgumentShape shape;
  std::size_t least = 0;  ///< numbers, points or sets
  std::size_t most = 0;
  std::string_view usage;  ///< for messages
};

/// The function of this name; null if there is none.
const Function* find_function(std::string_view name);

/// The names of all functions.
std::vector<std::string> function_names();

}  // namespace nef
