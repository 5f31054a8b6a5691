// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "nef/number/number.h"

namespace nef::minkowski {

/// R,N as --ball and --offset take it: a radius, and into how many parts the edges of an octahedron are split.
struct BallWords {
  Rational radius;
  int splits = 8;
};

/// Reads one; messages name `option`. Without N it is `splits`, and refused if that is nothing. Throws InputError.
BallWords parse_ball(const std::string& text, const std::string& option, std::optional<int> splits);

}  // namespace nef::minkowski
