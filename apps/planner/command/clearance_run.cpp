// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/runs.h"

#include <cmath>
#include <sstream>

#include "apps/planner/clearance/widest.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/free_space.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/number/brief_text.h"

namespace nef::planner {
namespace {

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

}  // namespace

nlohmann::json make_widest(const Arguments& a, Scene& scene) {
  if (!scene.start || !scene.goal) throw InputError(scene.name + ": --widest wants a start and a goal");
  const Rational precision = parse_rational(a.precision);
  if (precision <= 0) throw InputError("--precision must be positive");
  const Growth growth = a.widest_box ? Growth::kBox : Growth::kScale;
  const Polyhedron robot = scene.robot;
  Rational smallest = growth == Growth::kBox ? 0 : 1;
  TurningLimits limits;
  limits.max_cells = a.max_cells;
  const TimeLimit limit(a.time, a.session.monitor);
  const Widest widest = find_widest(smallest, precision, growth == Growth::kScale, [&](const Rational& size) {
    smallest = std::min(smallest, size);
    if (a.time && limit.passed() >= *a.time) return Verdict::kUndecided;
    try {
      scene.robot = grown(robot, growth, size, limit.monitor());
      return scene.rotation ? turning_verdict_on(scene, limits, limit.monitor()) : verdict_on(scene, limit.monitor());
    } catch (const Interrupted&) {
      return Verdict::kUndecided;
    }
  });
  scene.robot = grown(robot, growth, widest.low.value_or(smallest));
  nlohmann::json result{{"growth", growth == Growth::kBox ? "box" : "scale"},
                        {"undecided", widest.undecided},
                        {"questions", widest.questions}};
  for (const auto& [key, value] : {std::pair("low", &widest.low), std::pair("high", &widest.high)}) {
    if (!*value) continue;
    result[key] = to_string(**value);
    result[std::string(key) + "_double"] = nearest_double(**value);
  }
  return result;
}

std::string widest_text(const nlohmann::json& widest) {
  std::ostringstream out;
  const auto put = [&](const char* key) {
    out << brief_text(parse_rational(widest[key].get<std::string>())) << " ("
        << widest[std::string(key) + "_double"].get<double>() << ")";
  };
  out << "widest: ";
  if (widest.contains("low")) {
    out << "a path at ";
    put("low");
  } else {
    out << "no path at any size that was tried";
  }
  if (widest.contains("high")) {
    out << ", none at ";
    put("high");
  } else if (!widest["undecided"].get<bool>()) {
    out << ", and at any size that was tried";
  }
  if (widest["undecided"].get<bool>()) out << ", undecided between";
  out << '\n';
  return out.str();
}

}  // namespace nef::planner
