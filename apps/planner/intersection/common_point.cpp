// SPDX-License-Identifier: Apache-2.0
//
// Weights l_i + e of the points of a and m_j + e of those of b, all of l, m and e not negative, have a common point iff
//   sum (l_i + e) a_i - sum (m_j + e) b_j = 0,  sum (l_i + e) = 1,  sum (m_j + e) = 1:
// five equations. Phase 1 looks for a solution; if there is none, the dual solution is a plane strictly between the
// hulls (Farkas). Phase 2 makes e as large as can be; if that is 0, its dual solution is a plane that touches them.
#include "apps/planner/intersection/common_point.h"

#include <array>
#include <cstddef>
#include <vector>

#include "nef/base/error.h"

namespace nef::planner {
namespace {

constexpr std::size_t kRows = 5;

// Minimizes over the solutions of five equations in variables that are not negative. Columns: the variables, then one
// artificial variable for each equation, then the right side, which must not be negative.
class Simplex {
 public:
  Simplex(const std::vector<std::array<Rational, kRows>>& columns, const std::array<Rational, kRows>& right)
      : variables_(columns.size()) {
    for (std::size_t r = 0; r < kRows; ++r) {
      for (const auto& column : columns) rows_[r].push_back(column[r]);
      for (std::size_t k = 0; k < kRows; ++k) rows_[r].emplace_back(k == r ? 1 : 0);
      rows_[r].push_back(right[r]);
      basis_[r] = variables_ + r;
    }
  }

  // Minimizes the sum of the artificial variables. True if the equations have a solution.
  bool find_solution() {
    cost_.assign(variables_ + kRows + 1, 0);
    for (std::size_t c = 0; c < cost_.size(); ++c) {
      for (const auto& row : rows_) cost_[c] -= row[c];
      if (c >= variables_ && c < variables_ + kRows) cost_[c] += 1;
    }
    minimize();
    if (cost_.back() != 0) {
      for (std::size_t k = 0; k < kRows; ++k) dual_[k] = 1 - cost_[variables_ + k];
      return false;
    }
    for (std::size_t r = 0; r < kRows; ++r) drive_out(r);
    return true;
  }

  // Makes one variable as large as can be, after find_solution. It must be bounded.
  Rational maximize(std::size_t variable) {
    cost_.assign(variables_ + kRows + 1, 0);
    cost_[variable] = -1;
    for (std::size_t r = 0; r < kRows; ++r) {
      if (basis_[r] != variable) continue;
      for (std::size_t c = 0; c < cost_.size(); ++c) cost_[c] += rows_[r][c];
    }
    minimize();
    for (std::size_t k = 0; k < kRows; ++k) dual_[k] = -cost_[variables_ + k];
    return value(variable);
  }

  [[nodiscard]] Rational value(std::size_t variable) const {
    for (std::size_t r = 0; r < kRows; ++r) {
      if (basis_[r] == variable) return rows_[r].back();
    }
    return 0;
  }

  // y of the last optimum: y A_j <= c_j for every column, y times the right side the optimum.
  [[nodiscard]] const std::array<Rational, kRows>& dual() const { return dual_; }

 private:
  void minimize() {
    while (true) {
      // Bland's rule: the first column and the first basic variable that may, so that no basis comes twice.
      std::size_t column = 0;
      while (column < variables_ && cost_[column] >= 0) ++column;
      if (column == variables_) return;
      std::optional<std::size_t> best;
      Rational least;
      for (std::size_t r = 0; r < kRows; ++r) {
        if (rows_[r][column] <= 0) continue;
        const Rational ratio = rows_[r].back() / rows_[r][column];
        if (!best || ratio < least || (ratio == least && basis_[r] < basis_[*best])) {
          best = r;
          least = ratio;
        }
      }
      NEF_ASSERT(best);  // weights are bounded
      pivot(*best, column);
    }
  }

  // An artificial variable that is zero leaves the basis, unless its equation follows from the others.
  void drive_out(std::size_t row) {
    if (basis_[row] < variables_) return;
    for (std::size_t column = 0; column < variables_; ++column) {
      if (rows_[row][column] == 0) continue;
      pivot(row, column);
      return;
    }
  }

  void pivot(std::size_t row, std::size_t column) {
    const Rational factor = rows_[row][column];
    for (Rational& entry : rows_[row]) entry /= factor;
    const auto eliminate = [&](std::vector<Rational>& other) {
      const Rational times = other[column];
      if (times == 0) return;
      for (std::size_t c = 0; c < other.size(); ++c) {
        if (rows_[row][c] != 0) other[c] -= times * rows_[row][c];
      }
    };
    for (std::size_t r = 0; r < kRows; ++r) {
      if (r != row) eliminate(rows_[r]);
    }
    eliminate(cost_);
    basis_[row] = column;
  }

  std::size_t variables_;
  std::array<std::vector<Rational>, kRows> rows_;
  std::vector<Rational> cost_;  // reduced; its last entry is minus the value
  std::array<std::size_t, kRows> basis_{};
  std::array<Rational, kRows> dual_;
};

}  // namespace

HullWitness witness_of_hulls(std::span<const Rational3> a, std::span<const Rational3> b, bool inside) {
  std::vector<std::array<Rational, kRows>> columns;
  for (const Rational3& p : a) columns.push_back({p[0], p[1], p[2], 1, 0});
  for (const Rational3& p : b) columns.push_back({-p[0], -p[1], -p[2], 0, 1});
  const std::size_t least = columns.size();  // the variable e
  if (inside) {
    std::array<Rational, kRows> sum;
    for (const auto& column : columns) {
      for (std::size_t r = 0; r < kRows; ++r) sum[r] += column[r];
    }
    columns.push_back(sum);
  }
  Simplex program(columns, {0, 0, 0, 1, 1});
  Rational each = 0;
  const bool meet = program.find_solution();
  if (meet && inside) each = program.maximize(least);
  HullWitness result;
  if (!meet || (inside && each == 0)) {
    result.normal = {program.dual()[0], program.dual()[1], program.dual()[2]};
    return result;
  }
  result.common.emplace();
  for (std::size_t i = 0; i < a.size(); ++i) result.common->robot.emplace_back(program.value(i) + each);
  for (std::size_t j = 0; j < b.size(); ++j) result.common->obstacle.emplace_back(program.value(a.size() + j) + each);
  return result;
}

}  // namespace nef::planner
