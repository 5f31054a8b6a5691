// SPDX-License-Identifier: Apache-2.0
//
// Small linear programs in doubles, for guesses. Programs in four variables that are solved thousands of times for
// other bounds have their own solver, no_path/small_program.h.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace nef::planner {

/// Maximizes c x under A x <= b, x >= 0, where b >= 0: the simplex method from x = 0, largest coefficient first, with a
/// bounded number of pivots. Returns a point that is feasible up to rounding, and the best one unless the pivots end or
/// the program is unbounded.
Eigen::VectorXd maximize(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& c);

}  // namespace nef::planner
