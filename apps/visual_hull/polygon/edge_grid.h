// SPDX-License-Identifier: Apache-2.0
//
// A uniform grid over edges that come and go.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nef::visual_hull {

/// A rectangle low..high of doubles.
struct Rectangle {
  std::array<double, 2> low{INFINITY, INFINITY};
  std::array<double, 2> high{-INFINITY, -INFINITY};

  void add(const std::array<double, 2>& p) {
    for (std::size_t i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
};

/// Holds numbers of edges in the cells that their boxes touch. What lies outside of `bounds` is
/// kept in the cells at its border, so any query is answered completely: a superset of the edges
/// whose boxes overlap the query.
class EdgeGrid {
 public:
  EdgeGrid(const Rectangle& bounds, std::size_t edges) : low_(bounds.low) {
    const double width = std::max(bounds.high[0] - bounds.low[0], 1e-300);
    const double height = std::max(bounds.high[1] - bounds.low[1], 1e-300);
    const double cells = std::clamp(static_cast<double>(edges), 1.0, 4e6);
    const double side = std::max({std::sqrt(width / cells * height), width / 2000, height / 2000, 1e-300});
    inverse_ = 1 / side;
    count_ = {static_cast<std::int64_t>(width * inverse_) + 1, static_cast<std::int64_t>(height * inverse_) + 1};
    cells_.resize(static_cast<std::size_t>(count_[0] * count_[1]));
  }

  void insert(std::uint32_t edge, const Rectangle& box) {
    for_cells(box, [edge](std::vector<std::uint32_t>& cell) { cell.push_back(edge); });
  }

  void remove(std::uint32_t edge, const Rectangle& box) {
    for_cells(box, [edge](std::vector<std::uint32_t>& cell) {
      const auto it = std::find(cell.begin(), cell.end(), edge);
      if (it != cell.end()) {
        *it = cell.back();
        cell.pop_back();
      }
    });
  }

  /// Calls visit(edge) once for each edge near `box` until it returns false.
  template <typename Visit>
  void visit_near(const Rectangle& box, Visit&& visit) {
    ++stamp_;
    bool go_on = true;
    for_cells(box, [&](const std::vector<std::uint32_t>& cell) {
      for (std::size_t i = 0; i < cell.size() && go_on; ++i) {
        const std::uint32_t edge = cell[i];
        if (edge >= seen_.size()) seen_.resize(edge + std::size_t{1}, 0);
        if (seen_[edge] == stamp_) continue;
        seen_[edge] = stamp_;
        go_on = visit(edge);
      }
    });
  }

 private:
  std::int64_t cell_of(double value, std::size_t axis) const {
    const double cell = std::floor((value - low_[axis]) * inverse_);
    return static_cast<std::int64_t>(std::clamp(cell, 0.0, static_cast<double>(count_[axis] - 1)));
  }

  template <typename Visit>
  void for_cells(const Rectangle& box, Visit&& visit) {
    const std::int64_t x1 = cell_of(box.high[0], 0);
    const std::int64_t y1 = cell_of(box.high[1], 1);
    for (std::int64_t y = cell_of(box.low[1], 1); y <= y1; ++y) {
      for (std::int64_t x = cell_of(box.low[0], 0); x <= x1; ++x) {
        visit(cells_[static_cast<std::size_t>(y * count_[0] + x)]);
      }
    }
  }

  std::array<double, 2> low_;
  double inverse_ = 1;
  std::array<std::int64_t, 2> count_{};
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint64_t> seen_;
  std::uint64_t stamp_ = 0;
};

}  // namespace nef::visual_hull
