// SPDX-License-Identifier: Apache-2.0
//
// Points that go along while the robot turns, and stay inside of it and of an obstacle: in doubles, for a search whose
// result is checked exactly.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/orientation/orientation_cells.h"

namespace nef::planner {

/// A piece of the robot at all orientations of a box with three parameters. Let s be the parameters, from -1 to 1
/// within the box, and u + sum s_k drift_k a point seen from the reference point. It is inside the piece at all
/// orientations of the box if normal * u + sum drifts[k] * drift_k < offset for all of these half-spaces: for a face n
/// v <= c, (R n) (u + sum s_k drift_k) - c times the square of the quaternion is a polynomial whose degree in each
/// parameter is 3, so it lies between its 64 Bernstein coefficients (raised_form.h).
///
/// A point that does not drift has to be inside the robot at all orientations of a range; what the robot loses by that
/// grows with the range. Of a point that drifts along it grows with the square of the range.
struct DriftingPiece {
  struct HalfSpace {
    Vector3d normal;
    std::array<Vector3d, 3> drifts;
    double length = 0;  ///< of the normal
    double offset = 0;
    bool is_corner = false;  ///< what it says is about the orientation at a corner of the box
  };
  std::vector<HalfSpace> half_spaces;
};

/// That of a piece with these faces, from the mixed rotations of the box (27 matrices; otherwise there are no
/// half-spaces).
DriftingPiece drifting_piece(std::span<const Vector3d> normals, std::span<const double> offsets,
                             const std::vector<ScaledMatrix<double>>& matrices);

}  // namespace nef::planner
