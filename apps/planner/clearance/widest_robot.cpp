// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/clearance/widest_robot.h"

#include <algorithm>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/free_space.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"

namespace nef::planner {
namespace {

constexpr long kSmallestShare =
    1L << 20;  // no size below 1 / this of the first one, or of the robot's extent, is tried

Verdict verdict_on(const Scene& scene, const Monitor& monitor) {
  const FreeSpace free(free_positions(scene, monitor));
  const CellId start = free.locate(ExactPoint(*scene.start));
  const CellId goal = free.locate(ExactPoint(*scene.goal));
  if (!free.is_free(start) || !free.is_free(goal)) return Verdict::kNone;
  return free.component(start) == free.component(goal) ? Verdict::kPath : Verdict::kNone;
}

Verdict turning_verdict_on(const Scene& scene, const TurningLimits& limits, const Monitor& monitor) {
  switch (find_turning_path(scene, question_of(scene), limits, monitor).status) {
    case TurningAnswer::Status::kPath:
      return Verdict::kPath;
    case TurningAnswer::Status::kUndecided:
      return Verdict::kUndecided;
    default:
      return Verdict::kNone;
  }
}

// A robot that does not pass when it is enlarged by so little passes only as it is.
Rational least_cube(const Scene& scene) {
  Rational extent = 0;
  const std::optional<std::array<Rational3, 2>> box = bounding_box(scene.robot);
  for (std::size_t k = 0; box && k < 3; ++k) extent = std::max(extent, Rational((*box)[1][k] - (*box)[0][k]));
  for (std::size_t k = 0; extent == 0 && k < 3; ++k) extent = abs((*scene.goal)[k] - (*scene.start)[k]);  // a point
  return (extent == 0 ? Rational(1) : extent) / kSmallestShare;
}

}  // namespace

Widest widest_robot(Scene& scene, Growth growth, const WidestLimits& limits, const Monitor& monitor) {
  if (!scene.start || !scene.goal) throw InputError(scene.name + ": the widest robot needs a start and a goal");
  if (limits.precision <= 0) throw InputError("the precision must be positive");
  const Polyhedron robot = scene.robot;
  const Rational first = growth == Growth::kBox ? 0 : 1;
  const Rational least = growth == Growth::kBox ? least_cube(scene) : Rational(1, kSmallestShare);
  Rational smallest = first;
  TurningLimits of_turns;
  of_turns.max_cells = limits.max_cells;
  const TimeLimit time(limits.seconds, monitor);
  Widest widest = find_widest(first, least, limits.precision, [&](const Rational& size) {
    smallest = std::min(smallest, size);
    if (limits.seconds && time.passed() >= *limits.seconds) return Verdict::kUndecided;
    try {
      scene.robot = grown(robot, growth, size, time.monitor());
      return scene.rotation ? turning_verdict_on(scene, of_turns, time.monitor()) : verdict_on(scene, time.monitor());
    } catch (const Interrupted&) {
      monitor.check_interruption();
      return Verdict::kUndecided;
    }
  });
  scene.robot = grown(robot, growth, widest.low.value_or(smallest), monitor);
  return widest;
}

}  // namespace nef::planner
