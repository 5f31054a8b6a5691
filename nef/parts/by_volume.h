// SPDX-License-Identifier: Apache-2.0
//
// Pieces chosen by their volumes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/number/number.h"
#include "nef/polyhedron.h"

namespace nef {

/// The number of the piece of the largest volume, of several the first. Volumes are compared by bounds in doubles, and
/// exactly where these do not decide. There must be a piece. O(n), and what exact volumes take.
std::size_t largest_piece(std::span<const Polyhedron> pieces, const Monitor& monitor = {});

/// The pieces whose volume is above a bound, in their order. Compared in the same way.
std::vector<Polyhedron> pieces_above(std::vector<Polyhedron> pieces, const Rational& bound,
                                     const Monitor& monitor = {});

}  // namespace nef
