// SPDX-License-Identifier: Apache-2.0
//
// Bytes for files: little-endian arrays in a growing string, base64, deflate.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace nef::view {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

/// Appends the bytes of an array at an offset that is a multiple of four. Returns that offset.
template <typename T>
std::size_t append_array(std::string& bytes, std::span<const T> values, char padding = '\0') {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  const std::size_t offset = bytes.size();
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return offset;
}

/// Base64 with padding (RFC 4648, section 4). O(n).
std::string base64(std::string_view bytes);

/// A zlib stream (RFC 1950), as DecompressionStream("deflate") reads it. O(n).
std::string deflate(std::string_view bytes);

}  // namespace nef::view
