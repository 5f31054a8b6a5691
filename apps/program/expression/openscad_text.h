// SPDX-License-Identifier: Apache-2.0
//
// The text of OpenSCAD's .csg files: what its programs are when all their variables, loops and modules are done.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// A value in parentheses: undef, a number, true or false, a text, a list.
struct OpenScadValue {
  std::variant<std::monostate, Rational, bool, std::string, std::vector<OpenScadValue>> is;

  [[nodiscard]] const Rational* number() const { return std::get_if<Rational>(&is); }
  [[nodiscard]] const std::vector<OpenScadValue>* list() const { return std::get_if<std::vector<OpenScadValue>>(&is); }
};

/// NAME(arguments); or NAME(arguments) { children }
struct OpenScadNode {
  std::string name;
  std::size_t line = 1;
  std::vector<std::pair<std::string, OpenScadValue>> arguments;  ///< without a name: ""
  std::vector<OpenScadNode> children;

  /// The argument of this name, or the one without name at this place in the list; null if there is none or it is
  /// undef.
  [[nodiscard]] const OpenScadValue* find(std::string_view argument, std::size_t place) const;
};

/// The statements of a file as the children of a group. What is marked with * or % is left out, as OpenSCAD does.
/// Numbers are the decimals that they spell. Throws InputError with the line in front.
OpenScadNode parse_openscad(std::string_view text);

}  // namespace nef
