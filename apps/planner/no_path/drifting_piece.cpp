// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/no_path/drifting_piece.h"

#include <cstddef>

#include "apps/planner/orientation/raised_form.h"

namespace nef::planner {

namespace {

bool is_end(std::size_t index) { return index == 0 || index == 3; }

}  // namespace

DriftingPiece drifting_piece(std::span<const Vector3d> normals, std::span<const double> offsets,
                             const std::vector<ScaledMatrix<double>>& matrices) {
  DriftingPiece result;
  if (matrices.size() != 27) return result;
  constexpr std::size_t kNone = 3;
  QuadraticForm<double> scale{};
  for (std::size_t i = 0; i < 27; ++i) scale[i] = matrices[i].scale;
  const CubicForm<double> scales = raised(scale, kNone);
  result.half_spaces.reserve(64 * normals.size());
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const std::size_t first = result.half_spaces.size();
    result.half_spaces.resize(first + 64);
    for (std::size_t row = 0; row < 3; ++row) {
      QuadraticForm<double> form{};
      for (std::size_t i = 0; i < 27; ++i) {
        const auto& m = matrices[i].rows[row];
        form[i] = m[0] * normals[f][0] + m[1] * normals[f][1] + m[2] * normals[f][2];
      }
      const auto at = static_cast<Eigen::Index>(row);
      const CubicForm<double> still = raised(form, kNone);
      for (std::size_t c = 0; c < 64; ++c) result.half_spaces[first + c].normal[at] = still[c] / scales[c];
      for (std::size_t k = 0; k < 3; ++k) {
        const CubicForm<double> drifting = raised(form, k);
        for (std::size_t c = 0; c < 64; ++c) result.half_spaces[first + c].drifts[k][at] = drifting[c] / scales[c];
      }
    }
    for (std::size_t c = 0; c < 64; ++c) {
      DriftingPiece::HalfSpace& half_space = result.half_spaces[first + c];
      half_space.length = half_space.normal.norm();
      half_space.is_corner = is_end(c % 4) && is_end(c / 4 % 4) && is_end(c / 16);
      half_space.offset = offsets[f];
    }
  }
  return result;
}

}  // namespace nef::planner
