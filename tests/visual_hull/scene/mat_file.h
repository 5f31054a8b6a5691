// SPDX-License-Identifier: Apache-2.0
//
// Bytes of binary formats, MATLAB's version 5 among them.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace nef::visual_hull::testing {

/// Appends the bytes of a value as they lie in memory (little-endian on all machines that we know).
template <typename T>
void put(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

inline constexpr std::uint32_t kMatCell = 1;
inline constexpr std::uint32_t kMatDouble = 6;

/// One data element: type, size, bytes, padded to eight.
inline std::string mat_element(std::uint32_t type, const std::string& data) {
  std::string bytes;
  put<std::uint32_t>(bytes, type);
  put<std::uint32_t>(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += data;
  bytes.append((8 - data.size() % 8) % 8, '\0');
  return bytes;
}

/// An array: flags, dimensions, name, content (elements).
inline std::string mat_array(std::uint32_t kind, const std::vector<std::int32_t>& sizes, const std::string& name,
                             const std::string& content) {
  std::string flags;
  put<std::uint32_t>(flags, kind);
  put<std::uint32_t>(flags, 0);
  std::string dimensions;
  for (const std::int32_t n : sizes) put<std::int32_t>(dimensions, n);
  return mat_element(14, mat_element(6, flags) + mat_element(5, dimensions) + mat_element(1, name) + content);
}

/// What a file begins with.
inline std::string mat_header() {
  std::string bytes = "MATLAB 5.0 MAT-file, by hand";
  bytes.append(124 - bytes.size(), ' ');
  put<std::uint16_t>(bytes, 0x0100);
  put<std::uint16_t>(bytes, 0x4d49);
  return bytes;
}

}  // namespace nef::visual_hull::testing
