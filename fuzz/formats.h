// SPDX-License-Identifier: Apache-2.0
//
// Every file format of the suite: legal files to begin with, and readers that ask what was read whether it keeps its
// promises. For damaged files (files.cpp) and for libFuzzer (libfuzzer/).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "nef/polyhedron.h"

namespace nef::fuzz {

struct Format {
  std::string_view name;
  /// A legal file; mesh formats, and formats of polyhedra, hold what they can of the set, others what its text says.
  std::string (*write)(const Polyhedron& set, const std::string& text);
  /// Throws Error for bytes that are refused, Failure for a broken promise.
  void (*read)(const std::string& bytes);
};

std::span<const Format> formats();

}  // namespace nef::fuzz
