// SPDX-License-Identifier: Apache-2.0
//
// A failing case as a file:
//
//   fuzz 1                        the format
//   # ...                         the complaint and what the case told about itself
//   fuzzer nested
//   choices 3 0 17 ...
#pragma once

#include <string>

#include "fuzz/isolation.h"

namespace nef::fuzz {

std::string case_text(const Finding& finding);
/// Reads such a text; complaint and story are left out. Throws InputError.
Finding read_case(const std::string& text, const std::string& path);

}  // namespace nef::fuzz
