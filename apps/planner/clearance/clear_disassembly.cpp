// SPDX-License-Identifier: Apache-2.0
//
// Two parts enlarged by a symmetric polytope each have disjoint insides iff their distance, measured by twice that
// polytope, is not less than 1. A larger polytope lets less go.
#include "apps/planner/clearance/clear_disassembly.h"

#include <algorithm>
#include <numeric>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/clearance/widest.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/distance/nearest_features.h"

namespace nef::planner {
namespace {

Assembly enlarged(const Assembly& assembly, const Rational& radius, const Monitor& monitor) {
  Assembly result = assembly;
  const Polyhedron ball = around_ball(radius, monitor);
  minkowski::MinkowskiOptions options;
  options.monitor = monitor.quiet();
  for (Polyhedron& part : result.parts) part = minkowski::minkowski_sum(part, ball, options);
  return result;
}

// Two parts that are closer than a distance, exactly.
std::optional<std::pair<std::size_t, std::size_t>> close_parts(const Assembly& assembly, const Rational& distance,
                                                               const Monitor& monitor) {
  std::vector<std::array<Rational3, 2>> boxes;
  for (const Polyhedron& part : assembly.parts) boxes.push_back(*bounding_box(part, monitor));
  const auto far = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (boxes[a][0][k] - boxes[b][1][k] >= distance || boxes[b][0][k] - boxes[a][1][k] >= distance) return true;
    }
    return false;
  };
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      if (far(a, b)) continue;
      const bool apart = intersect(assembly.parts[a], assembly.parts[b], monitor).is_empty();
      if (!apart || nearest_features(assembly.parts[a].complex(), assembly.parts[b].complex(), monitor).squared <
                        distance * distance) {
        return std::pair{a, b};
      }
    }
  }
  return std::nullopt;
}

bool holds(const PartSet& set, const PartSet& some) {
  return std::includes(set.begin(), set.end(), some.begin(), some.end());
}

}  // namespace

Disassembly take_apart_clear(const Assembly& assembly, const Rational& distance, const DisassemblyOptions& options,
                             const Monitor& monitor) {
  if (distance <= 0) throw InputError("--keep-clear: the distance must be positive");
  Disassembly result;
  PartSet all(assembly.parts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  try {
    result.overlap = close_parts(assembly, distance, monitor);
    if (result.overlap) return result;
    result = take_apart(enlarged(assembly, distance / 2, monitor), options, monitor);
    if (!result.overlap && result.inseparable.empty()) return result;
    std::vector<Inseparable> in_doubt = std::exchange(result.inseparable, {});
    if (std::exchange(result.overlap, std::nullopt)) in_doubt.emplace_back().parts = all;
    // A polytope of 1.2 times the radius of a ball at most, so this one is inside the ball of half the distance.
    Disassembly proof;
    try {
      proof = take_apart(enlarged(assembly, distance / 2 * Rational(5, 6), monitor), options, monitor);
    } catch (const Interrupted&) {  // nothing is proved
    }
    for (const Inseparable& open : in_doubt) {
      bool all_proved = false;
      for (Inseparable& stuck : proof.inseparable) {
        if (!holds(open.parts, stuck.parts)) continue;
        all_proved = all_proved || stuck.parts == open.parts;
        result.inseparable.push_back(std::move(stuck));
      }
      if (!all_proved) result.undecided.push_back({open.parts, 1});
    }
  } catch (const Interrupted&) {
    result.undecided.push_back({all, 1});
  }
  return result;
}

}  // namespace nef::planner
