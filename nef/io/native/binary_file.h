// SPDX-License-Identifier: Apache-2.0
//
// A binary .nef file (native_binary.h) as columns, one after the other: its bytes, its numbers of items, and what is
// said of one that is damaged. What its columns mean is the reader's matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nef/io/native/binary_columns.h"
#include "nef/number/int128.h"
#include "nef/number/number.h"

namespace nef {

class BinaryFile {
 public:
  /// How many of each the file says that it holds; none is more than it has bytes.
  struct Counts {
    std::uint32_t planes = 0;
    std::uint32_t vertices = 0;
    std::uint32_t svertices = 0;
    std::uint32_t shalfedges = 0;
    std::uint32_t sloops = 0;
    std::uint32_t sfaces = 0;
    std::uint32_t entries = 0;
    std::uint32_t facets = 0;
    std::uint32_t cycles = 0;
    std::uint32_t isolated = 0;
    std::uint32_t shells = 0;
    std::uint32_t volumes = 0;
  };

  /// Reads what stands before the columns. Both must outlive this object. Throws FileError if the file ends early, is
  /// of another version, or has another checksum than that of its bytes. O(n).
  BinaryFile(std::string_view bytes, const std::string& path);

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Bytes of an index within a vertex: 1, 2 or 4.
  [[nodiscard]] std::uint32_t width() const { return width_; }
  /// Of all bytes but the checksum.
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  /// True once all columns have been taken.
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

  /// Throws FileError: the file says something that no polyhedron has.
  [[noreturn]] void corrupt(const std::string& what) const;
  /// The same unless something holds.
  void demand(bool holds, const char* what) const {
    if (!holds) corrupt(what);
  }

  /// The next column. Throws FileError if the file has not so many bytes.
  template <typename T>
  Column<T> column(std::size_t count) {
    demand(count <= (bytes_.size() - at_) / sizeof(T), "its numbers of items do not fit its length");
    const char* data = bytes_.data() + at_;
    at_ += count * sizeof(T);
    return Column<T>(data);
  }

  /// The next rows of numbers (planes, points), one after the other: take_short(row, words) for those of up to two
  /// words below 2^127, take_long(row, numbers) for others, whose limbs live as long as the call.
  template <std::size_t kWidth, typename TakeShort, typename TakeLong>
  void numbers(std::size_t rows, TakeShort&& take_short, TakeLong&& take_long) {
    constexpr std::size_t width = kWidth;
    const auto sizes = column<std::int32_t>(width * rows);
    const std::uint64_t limbs = column<std::uint64_t>(1)[0];
    const auto limb = column<mp_limb_t>(limbs);
    std::vector<mp_limb_t> row_limbs;
    std::array<mpz_t, kWidth> values;
    std::array<Int128, kWidth> words{};
    std::array<std::int32_t, kWidth> size{};
    std::uint64_t next = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      std::uint64_t total = 0;
      bool is_short = true;
      for (std::size_t i = 0; i < width; ++i) {
        size[i] = sizes[row * width + i];
        demand(size[i] > -0x40000000 && size[i] < 0x40000000, "a number is too long");
        total += static_cast<std::uint64_t>(size[i] < 0 ? -size[i] : size[i]);
        is_short = is_short && size[i] >= -2 && size[i] <= 2;
      }
      demand(total <= limbs - next, "its numbers are longer than it says");
      if (is_short) {
        std::uint64_t at = next;
        for (std::size_t i = 0; i < width; ++i) {
          const std::int32_t length = size[i] < 0 ? -size[i] : size[i];
          const mp_limb_t low = length > 0 ? limb[at] : 0;
          const mp_limb_t high = length > 1 ? limb[at + 1] : 0;
          at += static_cast<std::uint64_t>(length);
          demand(length == 0 || (length == 1 ? low : high) != 0, "a number begins with zeros");
          is_short = is_short && high >> 63U == 0;
          // Beyond 2^127 it is no word, nor used.
          const Unsigned128 absolute = static_cast<Unsigned128>(high) << 64U | low;
          words[i] = static_cast<Int128>(size[i] < 0 ? -absolute : absolute);
        }
        if (is_short) {
          next = at;
          take_short(row, words);
          continue;
        }
      }
      row_limbs.resize(total + 1);  // of a zero behind all others, GMP may read a limb
      for (std::uint64_t i = 0; i < total; ++i) row_limbs[i] = limb[next + i];
      next += total;
      const mp_limb_t* at = row_limbs.data();
      for (std::size_t i = 0; i < width; ++i) {
        const std::int32_t length = size[i] < 0 ? -size[i] : size[i];
        demand(length == 0 || at[length - 1] != 0, "a number begins with zeros");
        mpz_roinit_n(values[i], at, size[i]);
        at += length;
      }
      take_long(row, values);
    }
    demand(next == limbs, "its numbers are shorter than it says");
  }

 private:
  std::string_view bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
  std::uint32_t width_ = 0;
  Counts counts_;
};

}  // namespace nef
