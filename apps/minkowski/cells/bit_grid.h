// SPDX-License-Identifier: Apache-2.0
//
// Sets of cells of a grid, one bit each, and their sums.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nef::minkowski {

/// Cells of a box of them, in rows along x. A planar set has one layer.
class BitGrid {
 public:
  BitGrid() = default;
  BitGrid(std::uint32_t width, std::uint32_t height, std::uint32_t depth)
      : size_{width, height, depth}, words_((width + 63) / 64), bits_(std::size_t{words_} * height * depth, 0) {}

  [[nodiscard]] const std::array<std::uint32_t, 3>& size() const { return size_; }
  [[nodiscard]] bool has(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (row(y, z)[x / 64] >> (x % 64) & 1U) != 0;
  }
  void set(std::uint32_t x, std::uint32_t y, std::uint32_t z) { row(y, z)[x / 64] |= std::uint64_t{1} << (x % 64); }

  /// Takes the cells of another grid of the same size, too.
  void unite(const BitGrid& other);

  /// The cells that sums of a cell of p and one of q fill, if equal cells are added as cubes, or squares if both have
  /// one layer: of cells i and j, i + j and its upper neighbours along all axes. Nothing if it would take more than
  /// `budget` steps: words of rows of one grid times slabs of the other, equal runs of cells in layers upon each other.
  static std::optional<BitGrid> sum(const BitGrid& p, const BitGrid& q, std::size_t budget = kBudget);
  /// Measured: some 50 milliseconds.
  static constexpr std::size_t kBudget = std::size_t{1} << 26U;

 private:
  [[nodiscard]] std::uint64_t* row(std::uint32_t y, std::uint32_t z) {
    return bits_.data() + words_ * (std::size_t{z} * size_[1] + y);
  }
  [[nodiscard]] const std::uint64_t* row(std::uint32_t y, std::uint32_t z) const {
    return bits_.data() + words_ * (std::size_t{z} * size_[1] + y);
  }

  [[nodiscard]] bool row_is_empty(std::uint32_t y, std::uint32_t z) const;
  [[nodiscard]] BitGrid stretched(std::uint32_t along, std::uint32_t layers, std::size_t words) const;
  void add(const BitGrid& moved, std::uint32_t y, std::uint32_t z, std::uint32_t x);

  std::array<std::uint32_t, 3> size_{};
  std::size_t words_ = 0;  // of a row
  std::vector<std::uint64_t> bits_;
};

/// The cell along an axis that holds a place of a grid, in sizes of cells; 0 for places below it.
inline std::uint32_t cell_of(double place) { return place > 0 ? static_cast<std::uint32_t>(place) : 0; }

/// The cells that are not on the border and inside of what crosses the middles of rows at some places: an odd number of
/// these comes before the middle of such a cell. `crossed`: the places of each row (y + height z), in any order.
BitGrid cells_inside(const BitGrid& border, std::vector<std::vector<double>> crossed);

}  // namespace nef::minkowski
