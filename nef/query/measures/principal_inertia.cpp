// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>

#include "nef/base/error.h"
#include "nef/query/moments.h"

namespace nef {

PrincipalInertia principal_inertia(const Moments& moments) {
  const std::optional<Rational3> centre = moments.centroid();
  if (!centre) throw InputError("a set without volume has no principal axes of inertia");
  std::array<std::array<double, 3>, 3> tensor{};
  const Rational3x3 exact = moments.inertia(*centre);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) tensor[i][j] = nearest_double(exact[i][j]);
  }
  return principal_inertia(tensor);
}

PrincipalInertia principal_inertia(const std::array<std::array<double, 3>, 3>& tensor) {
  Eigen::Matrix3d m;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) m(i, j) = tensor[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
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
