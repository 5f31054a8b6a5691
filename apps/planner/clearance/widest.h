// SPDX-License-Identifier: Apache-2.0
//
// How much larger a robot could be and still find its way.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// How a robot grows.
enum class Growth : std::uint8_t {
  kScale,  ///< by a factor about its reference point; it must see all of itself from there (be star-shaped)
  kBox     ///< by the cube from -r to r, to the sum of both
};

/// The robot of a scene at a size: scaled by the factor, or summed with the cube. Size 1 (or 0) is the robot as it is.
/// Throws InputError for a scaled robot that is not a solid, or not star-shaped about its reference point: then a
/// smaller factor need not be easier. O(n), or one sum.
Polyhedron grown(const Polyhedron& robot, Growth growth, const Rational& size, const Monitor& monitor = {});

/// What is known about one size.
enum class Verdict : std::uint8_t { kPath, kNone, kUndecided };

/// There is a path at `low`, and proved to be none at `high`, however long one searches.
struct Widest {
  std::optional<Rational> low;   ///< nothing: no path at the smallest size that was tried
  std::optional<Rational> high;  ///< nothing: a path at the largest size that was tried
  bool undecided = false;        ///< a size between them could not be decided, so the interval is wider than wanted
  std::size_t questions = 0;
};

/// Bisection, for a verdict that is never better for larger sizes: until high - low <= precision * high, or, with a
/// path at 0, until high <= least. From size `first`, which may be 0, it goes up by doubling, to 2^20 times that, and
/// down by halving, to `least`, which is positive. Sizes are the simplest rationals near the middle, so that a critical
/// size that is simple is met exactly.
Widest find_widest(const Rational& first, const Rational& least, const Rational& precision,
                   const std::function<Verdict(const Rational&)>& verdict);

/// A polytope of 30 faces that holds the ball of this radius about the origin and lies in one 1.2 times as large.
Polyhedron around_ball(const Rational& radius, const Monitor& monitor = {});

/// Makes the robot larger by around_ball(distance): whatever is free then keeps at least that distance from all
/// obstacles, wherever the robot is turned, and all that keeps 1.2 times the distance is free. Adds a message that says
/// so. Throws InputError unless the distance is positive.
void keep_clear(Scene& scene, const Rational& distance, const Monitor& monitor = {});

}  // namespace nef::planner
