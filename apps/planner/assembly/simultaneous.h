// SPDX-License-Identifier: Apache-2.0
//
// Several parts that leave each other at once, each in a direction of its own.
#pragma once

#include <optional>
#include <vector>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/separation.h"
#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace nef::planner {

/// A vector for each of some parts: moved by its multiples from 0 to infinity, all at the same time, no two of them
/// overlap, which is exact; not all are equal, and the part of the largest box rests. Nothing if none was found, which
/// proves nothing. Tried are vectors away from a common point, which part all convex parts [Snoeyink, Stolfi 1994], and
/// those that open as many contacts as possible, by a linear program. Parts with equal vectors stay together. No parts
/// may overlap where they are.
std::optional<std::vector<Rational3>> simultaneous_motions(Blocking& blocking, const PartSet& parts,
                                                           const Monitor& monitor = {});

/// The multiple of such vectors at which the boxes of any two parts with different vectors are apart.
Rational simultaneous_end(const Blocking& blocking, const PartSet& parts, const std::vector<Rational3>& vectors);

}  // namespace nef::planner
