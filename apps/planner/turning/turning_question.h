// SPDX-License-Identifier: Apache-2.0
//
// What is asked about a robot that may turn about an axis through its reference point.
#pragma once

#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turn.h"

namespace nef::planner {

/// Where the reference point is, and how the robot is turned.
struct Pose {
  Rational3 position;
  Turn turn;
};

struct TurningQuestion {
  TurningAxis axis{{0, 0, 1}};
  /// The range of angles. One that is 4 wide is the full circle, closed to a ring. In a wider one (a joint whose cable
  /// winds up, say) angles that differ by full turns are different.
  Turn low = 0;
  Turn high = 4;
  Pose start;
  Pose goal;

  [[nodiscard]] bool is_ring() const { return high - low == 4; }
};

/// The question of a scene with a rotation, a start and a goal; InputError if one of these is missing. Angles become
/// rational turns; those of start and goal that are outside the range are
/// taken into it by full turns, if they can be.
TurningQuestion question_of(const Scene& scene);

}  // namespace nef::planner
