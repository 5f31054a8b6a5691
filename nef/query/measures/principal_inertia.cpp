// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>

#include "nef/base/error.h"
#include "nef/query/moments.h"

namespace nef {

PrincipalInertia principal_inertia(const Moments& moments) {
  const std::optional<Rational3> centre = moments.centroid();
  if (!centre) throw InputError("a set without volume has no principal axes of inertia");
  const Rational3x3 tensor = moments.inertia(*centre);
  Eigen::Matrix3d m;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      m(i, j) = nearest_double(tensor[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  PrincipalInertia result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    result.moments[i] = solver.eigenvalues()(column);
    for (std::size_t j = 0; j < 3; ++j) result.axes[i][j] = axes(static_cast<Eigen::Index>(j), column);
  }
  return result;
}

}  // namespace nef
