// SPDX-License-Identifier: Apache-2.0
//
// Parsers of other libraries, under limits of time and memory.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace nef {

/// Calls `work` in a process of its own that may use `seconds` of processor time and `bytes` more memory than this one
/// does now, and returns its result: for code of others that may run or grow for ever on damaged input. Nothing if it
/// was stopped by one of these bounds or crashed. An InputError in `work` is thrown here with the same text. May be
/// called from a program with threads if `work` takes none of their locks (malloc's are fine). The memory is not
/// bounded where an address sanitizer runs.
std::optional<std::string> run_bounded(std::size_t bytes, unsigned seconds, const std::function<std::string()>& work);

}  // namespace nef
