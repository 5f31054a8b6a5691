// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_search/linear_program.h"

namespace nef::planner {

Eigen::VectorXd maximize(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& c) {
  using Index = Eigen::Index;
  const Index rows = a.rows();
  const Index columns = a.cols();
  // The columns are those of the variables that are zero, one after the other exchanged for slacks; the last column is
  // the right-hand side, the last row the objective.
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Table t(rows + 1, columns + 1);
  t.topLeftCorner(rows, columns) = a;
  t.topRightCorner(rows, 1) = b;
  t.bottomLeftCorner(1, columns) = -c.transpose();
  t(rows, columns) = 0;
  std::vector<Index> basic(static_cast<std::size_t>(rows), -1);    // the variable of a row, -1 for a slack
  std::vector<Index> variable(static_cast<std::size_t>(columns));  // that of a column, -1 for a slack
  for (Index j = 0; j < columns; ++j) variable[static_cast<std::size_t>(j)] = j;
  constexpr int kMostPivots = 300;
  constexpr double kSmall = 1e-11;
  for (int pivot = 0; pivot < kMostPivots; ++pivot) {
    Index column = 0;
    if (t.row(rows).head(columns).minCoeff(&column) > -kSmall) break;
    Index row = -1;
    double best = 0;
    for (Index i = 0; i < rows; ++i) {
      if (t(i, column) <= kSmall) continue;
      const double ratio = t(i, columns) / t(i, column);
      if (row < 0 || ratio < best) {
        row = i;
        best = ratio;
      }
    }
    if (row < 0) break;
    const double inverse = 1 / t(row, column);
    t.row(row) *= inverse;
    t(row, column) = inverse;
    for (Index i = 0; i <= rows; ++i) {
      const double factor = t(i, column);
      if (i == row || factor == 0) continue;
      t(i, column) = 0;
      t.row(i) -= factor * t.row(row);
    }
    std::swap(basic[static_cast<std::size_t>(row)], variable[static_cast<std::size_t>(column)]);
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(columns);
  for (Index i = 0; i < rows; ++i) {
    const Index which = basic[static_cast<std::size_t>(i)];
    if (which >= 0) x[which] = std::max(0.0, t(i, columns));
  }
  return x;
}

}  // namespace nef::planner
