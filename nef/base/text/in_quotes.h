// SPDX-License-Identifier: Apache-2.0
//
// Bytes of unknown origin, names and words of files, as text that can be shown.
#pragma once

#include <string>
#include <string_view>

namespace nef {

/// The bytes with U+FFFD for every byte that belongs to no UTF-8 sequence: names of files may be anything, but JSON,
/// HTML and glTF are UTF-8. O(n).
std::string utf8(std::string_view bytes);

/// A word of a file for an error message: in quotes, at most forty characters of it, control characters and bytes that
/// are no UTF-8 as \xhh, so that no terminal takes them for commands.
std::string in_quotes(std::string_view word);

}  // namespace nef
