// SPDX-License-Identifier: Apache-2.0
//
// The columns of a binary file (native_binary.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "nef/complex/complex.h"

namespace nef {

/// Values that lie in the file.
template <typename T>
class Column {
 public:
  explicit Column(const char* data) : data_(data) {}
  T operator[](std::size_t i) const {
    T value;
    std::memcpy(&value, data_ + i * sizeof(T), sizeof(T));
    return value;
  }
  /// Some of them as they lie there.
  [[nodiscard]] std::string_view bytes(std::size_t first, std::size_t count) const {
    return {data_ + first * sizeof(T), count * sizeof(T)};
  }

 private:
  const char* data_;
};

/// The columns of the items of sphere maps; W is the number of bytes of local indices.
template <typename W>
struct ItemColumns {
  Column<std::uint32_t> p, q;
  Column<W> out, sface_around;
  Column<LabelId> svertex_mark;
  Column<std::uint32_t> plane;
  Column<LabelId> shalfedge_mark;
  Column<W> source, next, sface;
  Column<std::uint32_t> sloop_plane;
  Column<LabelId> sloop_mark;
  Column<W> sloop_sface;
  Column<W> entry_count;
  Column<LabelId> sface_mark;
  Column<std::uint8_t> kind;
  Column<W> index;

  /// Of a vertex whose items begin at `begin` and end before those at `end`.
  [[nodiscard]] std::uint64_t entries_of(const VertexRecord& begin, const VertexRecord& end) const {
    std::uint64_t sum = 0;
    for (const SFaceId f : IdRange<SFaceId>(begin.sfaces, end.sfaces)) sum += entry_count[f.index()];
    return sum;
  }
};

}  // namespace nef
