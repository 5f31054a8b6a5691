// SPDX-License-Identifier: Apache-2.0
//
// A grid of cells that is an oracle for sets of prisms: the plane is cut by the lines x = i, y = j, x + y = k, x - y =
// k, space by these lines' vertical planes and z = l, for all integers. A set made of prisms over polygons of such
// lines holds each cell whole or not at all.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/number/number.h"

namespace nef::fuzz {

/// A convex piece: a point, segment or convex polygon in the plane, counterclockwise, times an interval of heights.
struct Prism {
  std::vector<std::array<int, 2>> base;
  int bottom = 0;
  int top = 0;
};

/// Cells over the square from 0 to `width` and from height 0 to `height`. Everything that is made stays at least 1 away
/// from the border, so that the cells there stand for the rest of space.
class Tiling {
 public:
  using Marks = std::vector<std::uint8_t>;  ///< one for each cell

  Tiling(int width, int height);

  [[nodiscard]] std::size_t size() const { return flat_.size() * layers(); }
  /// A point of a cell.
  [[nodiscard]] Rational3 point(std::size_t cell) const;
  /// 2 z of the layer of a cell.
  [[nodiscard]] int layer(std::size_t cell) const { return static_cast<int>(cell / flat_.size()); }

  [[nodiscard]] Marks marks_of(const Prism& prism, bool open) const;
  /// For marks 0 and 1.
  [[nodiscard]] Marks closure(const Marks& marks) const;

 private:
  struct FlatCell {
    std::array<int, 2> point;  // four times its coordinates
    std::vector<std::uint32_t> faces;
  };
  [[nodiscard]] std::size_t layers() const { return 2 * static_cast<std::size_t>(height_) + 1; }
  void add(int x, int y, const std::vector<std::array<int, 2>>& faces);
  [[nodiscard]] std::uint32_t& at(int x, int y) {
    return number_[static_cast<std::size_t>(y) * static_cast<std::size_t>(4 * width_ + 1) +
                   static_cast<std::size_t>(x)];
  }

  int width_;
  int height_;
  std::vector<FlatCell> flat_;
  std::vector<std::uint32_t> number_;
};

}  // namespace nef::fuzz
