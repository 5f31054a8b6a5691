// SPDX-License-Identifier: Apache-2.0
//
// Way-points with simple coordinates. Every change is checked exactly before it is made.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "nef/number/number.h"

namespace nef::planner {

/// True if the closed segment between two points may be used.
using SegmentCheck = std::function<bool(const Rational3&, const Rational3&)>;

/// Takes needless wobble out of a path whose segments are allowed: where a coordinate is the same at two way-points, it
/// stays so between them if that is allowed and no longer; elsewhere it becomes that of a neighbour, or a simple number
/// near by, on the same terms. The ends stay. O(n^2) checks for n way-points at worst.
void straighten(const SegmentCheck& allowed, std::vector<Rational3>& path);

/// The multiple of 10^-digits that is nearest to a number.
Rational rounded(const Rational& x, unsigned digits);

/// The least multiple of 10^-digits that is not below a number.
Rational rounded_up(const Rational& x, unsigned digits);

/// Points near `x` that are worth trying in place of it, the nearest to it in each group: all coordinates rounded to
/// `digits` decimals, up or down, then two of them, then one. Never `x` itself.
std::vector<Rational3> rounded_points(const Rational3& x, unsigned digits);

/// True if no coordinate has more than so many decimals.
bool is_rounded(const Rational3& x, unsigned digits);

/// The indices of way-points between the ends that have coordinates with more decimals.
std::vector<std::size_t> unrounded_points(const std::vector<Rational3>& path, unsigned digits);

/// Rounds the way-points between the ends to `digits` decimals as far as that is allowed; where all coordinates cannot
/// be rounded, as many as can be. Returns the indices of those with coordinates that have more digits: in passages that
/// are tight, or narrower than 10^-digits.
std::vector<std::size_t> round_points(const SegmentCheck& allowed, std::vector<Rational3>& path, unsigned digits);

}  // namespace nef::planner
