// SPDX-License-Identifier: Apache-2.0
//
// Rotations with short numbers: nested grids of the rotation group, and steps between rotations.
//
// A rotation is written as the quaternion whose component of largest size is 1, the first one if several are. The
// boundary of the cube [-1, 1]^4 with opposite points identified is the rotation group, so the points of it whose
// coordinates are multiples of 2^-level are a grid of rotations. Grids nest; that of level 0 has 40 rotations, among
// them the 24 that permute the coordinate axes.
#pragma once

#include <vector>

#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// The quaternion of the same rotation whose component of largest size is 1; of several, the first one. It must not be
/// zero.
Quaternion canonical(const Quaternion& q);

/// The rotation that first turns by `first`, then by `second`.
Quaternion product(const Quaternion& second, const Quaternion& first);

/// An estimate of the angle between two rotations, in radians, from 0 to pi: within a twelfth of it, by additions,
/// multiplications and square roots alone, so that it is the same on all machines.
double angle_between(const Quaternion& p, const Quaternion& q);

/// The rotation at a parameter of the shorter arc, 0 <= s <= 1, not canonical.
Quaternion rotation_at(const Quaternion& from, const Quaternion& to, const Rational& s);

/// Whether a canonical quaternion belongs to the grid of a level.
bool is_in_grid(const Quaternion& q, unsigned level);

/// The rotations around a canonical quaternion in the grid of a level: the neighbours of one in the grid (26 or
/// more, some of them perhaps twice, none a half turn away), and the corners of the cell that holds another one.
std::vector<Quaternion> grid_neighbours(const Quaternion& q, unsigned level);

/// The rotation nearest to a quaternion in doubles, in the grid of a level, roughly. Canonical.
Quaternion rounded_to_grid(const std::array<double, 4>& q, unsigned level);

}  // namespace nef::planner
