// SPDX-License-Identifier: Apache-2.0
//
// JSON whose numbers keep their text.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// Parses JSON; a number with a fraction or exponent becomes an object {"$number": "text"}, so that
/// 0.1 can be read as one tenth. Throws InputError "name:line: what" for malformed text, a key given twice, and more
/// than 100 levels.
nlohmann::json parse_exact_json(const std::string& text, const std::string& name);

/// A parsed value as people wrote it, for messages: numbers keep their text.
std::string spelled(const nlohmann::json& value);

/// The rational of an integer, a number from parse_exact_json or a string. Throws InputError naming
/// `what`.
Rational rational_of(const nlohmann::json& value, const std::string& what);

/// All numbers of an array, however nested, in their order. Throws InputError.
std::vector<Rational> rationals_of(const nlohmann::json& value, const std::string& what);

/// Three of them from an array.
Rational3 point_of(const nlohmann::json& value, const std::string& what);

/// Arrays of exact strings, of points or any numbers, and of nearest doubles.
nlohmann::json exact_json(std::span<const Rational> numbers);
nlohmann::json double_json(const Rational3& point);

}  // namespace nef
