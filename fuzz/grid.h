// SPDX-License-Identifier: Apache-2.0
//
// Sets on the integer grid: its points, open unit edges, open unit squares and open unit cubes are cells that a set
// holds whole or not at all. Sums of cells are unions of cells, so Minkowski sums are counting.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/fuzzer.h"

namespace nef::fuzz {

/// A cell by twice its centre: even coordinates are points, odd ones open unit intervals.
using GridCell = std::array<int, 3>;

/// A set of cells with doubled coordinates from `low` to `high`.
class GridSet {
 public:
  GridSet(int low, int high)
      : low_(low), span_(high - low + 1), bits_(static_cast<std::size_t>(span_) * span_ * span_, 0) {}

  [[nodiscard]] int low() const { return low_; }
  [[nodiscard]] int high() const { return low_ + span_ - 1; }
  /// False for cells beyond the range.
  [[nodiscard]] bool holds(const GridCell& c) const { return in_range(c) && bits_[index(c)] != 0; }
  [[nodiscard]] bool in_range(const GridCell& c) const;
  void set(const GridCell& c, bool value) { bits_[index(c)] = value ? 1 : 0; }
  void for_each(const std::function<void(const GridCell&)>& visit) const;
  [[nodiscard]] std::vector<GridCell> cells() const;

  /// { a + b }, over the sum of both ranges.
  [[nodiscard]] static GridSet sum(const GridSet& a, const GridSet& b);
  [[nodiscard]] GridSet negated() const;

  [[nodiscard]] std::size_t index(const GridCell& c) const {
    return (static_cast<std::size_t>(c[0] - low_) * static_cast<std::size_t>(span_) +
            static_cast<std::size_t>(c[1] - low_)) *
               static_cast<std::size_t>(span_) +
           static_cast<std::size_t>(c[2] - low_);
  }

 private:
  int low_;
  int span_;
  std::vector<std::uint8_t> bits_;
};

/// The centre of a cell.
Rational3 point_of(const GridCell& c);

/// A set in both forms, and as text for `nef eval`.
struct GridPolyhedron {
  GridSet cells;
  Polyhedron set;
  std::string text = "nothing";

  explicit GridPolyhedron(int width) : cells(0, 2 * width) {}
  /// op: one of + - ^; a closed box in whole units, flat in some directions perhaps, or an open one.
  void combine(char op, const std::array<int, 3>& low, const std::array<int, 3>& high, bool open);
};

/// Random boxes, united, taken away or exchanged, within 0 .. width in all directions; never empty.
GridPolyhedron random_grid_set(Choices& choices, int width, bool closed);

/// Gives labels other than 1 to random parts of one of four sets, which stay the same points. What that was is in
/// `text`.
void label_some_sets(Choices& choices, GridPolyhedron& set);

}  // namespace nef::fuzz
