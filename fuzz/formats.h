// SPDX-License-Identifier: Apache-2.0
//
// Every file format of the suite: legal files to begin with, and readers that ask what was read whether it keeps its
// promises. For damaged files (files.cpp) and for libFuzzer (libfuzzer/).
#pragma once

#include <functional>
#include <span>
#include <string>

#include "nef/polyhedron.h"

namespace nef::fuzz {

struct Format {
  std::string name;
  /// A legal file; mesh formats, and formats of polyhedra, hold what they can of the set, others what its text says.
  std::function<std::string(const Polyhedron& set, const std::string& text)> write;
  /// Throws Error for bytes that are refused, Failure for a broken promise.
  std::function<void(const std::string& bytes)> read;
};

/// The mesh formats of the table of the library (nef/io/mesh/mesh_formats.h), then all others.
std::span<const Format> formats();

}  // namespace nef::fuzz
