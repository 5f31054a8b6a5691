// SPDX-License-Identifier: Apache-2.0
//
// The grid of x, y, x + y, x - y and z at whole numbers: a set is known cell by cell, without any geometry but that of
// the grid.
#pragma once

#include <array>
#include <vector>

namespace nef::test::nested {

inline constexpr int kWidth = 16;  ///< x and y run from 0 to kWidth
inline constexpr int kHeight = 6;  ///< z runs from 0 to kHeight
inline constexpr int kScale = 32;  ///< samples stand at multiples of a quarter; steps to cells near by are a sixteenth
using Point = std::array<int, 3>;  ///< in units of 1 / kScale, or whole

/// One cell of the grid: vertices, edges, triangles of the planes x, y, x + y, x - y = const times vertices and edges
/// of z. Cells are told apart, and sampled, by a point of theirs. Cells from 0 to kWidth suffice, since nothing that is
/// made touches the border.
class Grid {
 public:
  Grid() : in_(kCells, false) {}

  static constexpr int kPlanar = kWidth * kWidth * 12;
  static constexpr int kCells = kPlanar * 2 * kHeight;

  /// The cell of a point.
  static int cell(const Point& p) {
    const int u = p[0] % kScale;
    const int v = p[1] % kScale;
    const int square = (p[0] / kScale) * kWidth + p[1] / kScale;
    int kind = 0;
    if (u == 0 && v == 0) {
      kind = 0;
    } else if (v == 0) {
      kind = 1;
    } else if (u == 0) {
      kind = 2;
    } else {
      const int rising = (u > v) - (u < v);
      const int falling = (u + v > kScale) - (u + v < kScale);
      // Centre; four half diagonals; four triangles.
      constexpr std::array<int, 9> kKinds{8, 4, 9, 5, 3, 6, 10, 7, 11};
      const int place = 3 * (rising + 1) + falling + 1;
      kind = kKinds[static_cast<std::size_t>(place)];
    }
    const int level = 2 * (p[2] / kScale) + (p[2] % kScale != 0 ? 1 : 0);
    return (square * 12 + kind) * 2 * kHeight + level;
  }

  /// A point of each cell.
  static const std::vector<Point>& samples() {
    static const std::vector<Point> result = [] {
      std::vector<Point> points(kCells, Point{-1, -1, -1});
      for (int x = 0; x < kWidth * kScale; x += kScale / 4) {
        for (int y = 0; y < kWidth * kScale; y += kScale / 4) {
          for (int z = 0; z < kHeight * kScale; z += kScale / 2) {
            points[static_cast<std::size_t>(cell({x, y, z}))] = {x, y, z};
          }
        }
      }
      return points;
    }();
    return result;
  }

  [[nodiscard]] bool in(int cell) const { return in_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] bool in(const Point& p) const { return in(cell(p)); }
  void set(int cell, bool value) { in_[static_cast<std::size_t>(cell)] = value; }

  /// The cells that every neighbourhood of a cell meets, itself among them: where its sample goes by a small step along
  /// one of the eight rays of the grid, or between two of them.
  template <typename Visit>
  static void for_each_near(int cell_index, Visit&& visit) {
    static constexpr std::array<std::array<int, 2>, 17> kSteps{{{0, 0},
                                                                {2, 0},
                                                                {2, 1},
                                                                {2, 2},
                                                                {1, 2},
                                                                {0, 2},
                                                                {-1, 2},
                                                                {-2, 2},
                                                                {-2, 1},
                                                                {-2, 0},
                                                                {-2, -1},
                                                                {-2, -2},
                                                                {-1, -2},
                                                                {0, -2},
                                                                {1, -2},
                                                                {2, -2},
                                                                {2, -1}}};
    const Point& p = samples()[static_cast<std::size_t>(cell_index)];
    for (const auto& step : kSteps) {
      for (int dz = -1; dz <= 1; ++dz) {
        const Point q{p[0] + step[0], p[1] + step[1], p[2] + dz};
        if (q[0] >= 0 && q[1] >= 0 && q[2] >= 0) visit(cell(q));
      }
    }
  }

  [[nodiscard]] Grid interior() const {
    Grid result;
    for (int c = 0; c < kCells; ++c) {
      bool all = in(c);
      if (all) for_each_near(c, [&](int d) { all = all && in(d); });
      result.set(c, all);
    }
    return result;
  }
  [[nodiscard]] Grid closure() const {
    Grid result;
    for (int c = 0; c < kCells; ++c) {
      bool any = in(c);
      if (!any) for_each_near(c, [&](int d) { any = any || in(d); });
      result.set(c, any);
    }
    return result;
  }

 private:
  std::vector<bool> in_;
};

}  // namespace nef::test::nested
