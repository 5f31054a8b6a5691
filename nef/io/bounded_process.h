// SPDX-License-Identifier: Apache-2.0
//
// Parsers of other libraries, under limits of time and memory.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace nef {

/// What a parser of another library may use.
struct ParserLimits {
  std::size_t bytes = 0;  ///< of memory
  unsigned seconds = 0;   ///< of processor time
};

/// The limits for a file of `size` bytes: 512 MiB and 256 times the file, 20 s and one more for each 256 KiB. Far more
/// than sound files take.
constexpr ParserLimits parser_limits(std::size_t size) {
  return {.bytes = (std::size_t{512} << 20U) + 256 * size, .seconds = 20 + static_cast<unsigned>(size >> 18U)};
}

/// "so many MB and so many s"
std::string limits_text(const ParserLimits& limits);

/// Calls `work` in a process of its own that may use so much processor time (and four times that on the wall, as it may
/// wait for something that never comes) and so much more memory than this one does now, and returns its result: for
/// code of others that may run or grow for ever on damaged input. Nothing if it was stopped by one of these bounds or
/// crashed. An InputError in `work` is thrown here with the same text. May be
/// called from a program with threads if `work` takes none of their locks (malloc's are fine). The memory is not
/// bounded where an address sanitizer runs.
std::optional<std::string> run_bounded(const ParserLimits& limits, const std::function<std::string()>& work);

}  // namespace nef
