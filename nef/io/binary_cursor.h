// SPDX-License-Identifier: Apache-2.0
//
// Reads integers and floats of either byte order from the bytes of a file.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "nef/io/file_bytes.h"

namespace nef {

/// A position in a binary file, which knows the byte offset for error messages.
class BinaryCursor {
 public:
  BinaryCursor(std::string_view bytes, const std::string& path, std::size_t position, std::endian order)
      : bytes_(bytes), path_(path), position_(position), order_(order) {}

  /// The next sizeof(T) bytes as a T. Throws FileError (kTruncated).
  template <typename T>
  T take(std::string_view what) {
    std::array<char, sizeof(T)> raw;
    if (bytes_.size() - position_ < sizeof(T)) {
      fail(FileProblem::kTruncated, "the file ends in the middle of the " + std::string(what) + "; it is truncated");
    }
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size() - position_; }

  [[noreturn]] void fail(FileProblem problem, const std::string& what, FileElement element = {}) const {
    throw FileError(problem, path_ + ": byte " + std::to_string(position_) + ": " + what, element);
  }

 private:
  std::string_view bytes_;
  const std::string& path_;
  std::size_t position_;
  std::endian order_;
};

}  // namespace nef
