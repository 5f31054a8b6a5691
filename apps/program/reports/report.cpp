// SPDX-License-Identifier: Apache-2.0
#include "apps/program/reports/report.h"

#include <algorithm>
#include <vector>

#include "apps/program/set_info.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/number/brief_text.h"
#include "nef/polyhedron.h"

namespace nef {
Json info_json(const Polyhedron& set, const Monitor& monitor) { return set_info(set, {}, monitor); }

std::string summary(const Polyhedron& set) {
  if (set.is_empty()) return "the empty set";
  if (set.is_everything()) return "all of space";
  const Counts count = counts(set);
  const auto part = [](std::size_t n, const std::string& one, const std::string& many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
  };
  return part(count.vertices, "vertex", "vertices") + ", " + part(count.edges, "edge", "edges") + ", " +
         part(count.facets, "facet", "facets") + ", " + part(count.volumes, "volume", "volumes") + ", " +
         part(count.shells, "shell", "shells");
}

std::string point_text(const Rational3& point) {
  return brief_text(point[0]) + "," + brief_text(point[1]) + "," + brief_text(point[2]);
}

Json point_json(const Rational3& point) {
  return Json::array({to_string(point[0]), to_string(point[1]), to_string(point[2])});
}

Measured measure(int repeat, const Monitor& monitor, const std::function<Polyhedron(const Monitor&)>& operation) {
  Measured result;
  std::vector<double> times;
  for (int i = 0; i < std::max(repeat, 1); ++i) {
    times.push_back(0);
    result.predicates = {};
    Polyhedron set = [&] {
      const PhaseTimer phase(times.back(), result.predicates, monitor);
      return operation(phase.monitor());
    }();
    // The set of an earlier round goes outside of the time that is taken.
    result.set = std::move(set);
  }
  std::sort(times.begin(), times.end());
  const std::size_t middle = times.size() / 2;
  result.seconds = times.size() % 2 == 1 ? times[middle] : (times[middle - 1] + times[middle]) / 2;
  return result;
}

void finish(Session& session, const std::string& command, const Measured& measured, const Json& more) {
  session.store(measured.set);
  if (!session.json) {
    session.say(summary(measured.set));
    return;
  }
  session.spent("op", measured.seconds, measured.predicates);
  Json found{{"repeat", session.repeat}};
  found.update(more);
  found["result"] = info_json(measured.set, session.monitor);
  session.print(command, found);
}

}  // namespace nef
