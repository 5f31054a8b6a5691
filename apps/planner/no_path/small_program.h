// SPDX-License-Identifier: Apache-2.0
//
// Linear programs in few variables, in doubles: for what is checked exactly afterwards.
//
// Its twin is rigid_search/linear_program.h, which has any number of variables and needs a point to begin with: the
// dual of a program here is one of its programs. With that in its place, proofs that a cube, a box and a ball have no
// path through a window take 1.14, 1.18 and 1.04 times as long (CPU s, 2026-11-28).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace nef::planner {

/// Maximizes an objective over a x <= b, |x| at most a given bound. The dual simplex method: the basis is N rows whose
/// cone contains the objective; the row that is violated most comes in for the one that keeps the objective in the
/// cone. About O(N) steps of O(rows N) for the programs here. Results may be off by rounding, and a program that needs
/// very many steps counts as infeasible, so users must check what they take from it.
template <std::size_t N>
class SmallProgram {
 public:
  using Row = std::array<double, N>;

  /// Makes room for so many rows.
  void reserve(std::size_t rows) {
    rows_.reserve(rows);
    bounds_.reserve(rows);
  }
  void add(const Row& row, double bound) {
    rows_.push_back(row);
    bounds_.push_back(bound);
  }
  /// Replaces the bound of a row.
  void set_bound(std::size_t row, double bound) { bounds_[row] = bound; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// The point with the largest objective * x; nothing if no point satisfies all rows, or if the objective is known not
  /// to exceed `enough`. No component of x is larger than `limit`.
  [[nodiscard]] std::optional<Row> maximize(const Row& objective, double limit, double enough) const {
    std::array<Row, N> inverse{};  // of the basis' rows: x = inverse * bounds
    Row basic{};                   // the bounds of the basis
    for (std::size_t i = 0; i < N; ++i) {
      inverse[i][i] = objective[i] < 0 ? -1 : 1;
      basic[i] = limit;
    }
    constexpr int kMostSteps = 100;
    for (int step = 0; step < kMostSteps; ++step) {
      Row x{};
      double value = 0;
      for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t k = 0; k < N; ++k) x[i] += inverse[i][k] * basic[k];
        value += objective[i] * x[i];
      }
      if (value <= enough) return std::nullopt;
      const auto entering = most_violated(x, limit);
      if (!entering) return x;
      const Row& row = rows_[*entering];
      // The combination of the basis that the row is, and that of the objective; the first one to become negative goes.
      std::size_t leaving = N;
      double least = 0;
      Row part{};
      for (std::size_t i = 0; i < N; ++i) {
        double weight = 0;
        for (std::size_t k = 0; k < N; ++k) {
          part[i] += row[k] * inverse[k][i];
          weight += objective[k] * inverse[k][i];
        }
        if (part[i] <= 1e-12) continue;
        const double ratio = std::fmax(weight, 0) / part[i];
        if (leaving < N && (ratio > least || (ratio == least && part[i] <= part[leaving]))) continue;
        leaving = i;
        least = ratio;
      }
      if (leaving == N) return std::nullopt;
      for (Row& line : inverse) {
        const double pivot = line[leaving] / part[leaving];
        for (std::size_t i = 0; i < N; ++i) line[i] -= part[i] * pivot;
        line[leaving] = pivot;
      }
      basic[leaving] = bounds_[*entering];
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<std::size_t> most_violated(const Row& x, double limit) const {
    double most = 1e-11 * (1 + limit);
    std::optional<std::size_t> found;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      double over = -bounds_[r];
      for (std::size_t k = 0; k < N; ++k) over += rows_[r][k] * x[k];
      if (over <= most) continue;
      most = over;
      found = r;
    }
    return found;
  }

  std::vector<Row> rows_;
  std::vector<double> bounds_;
};

}  // namespace nef::planner
