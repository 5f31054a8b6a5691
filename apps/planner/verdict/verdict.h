// SPDX-License-Identifier: Apache-2.0
//
// One answer about parts at their places: who overlaps whom, how far apart they are, and which of them can be taken
// away.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/assembly/free_directions.h"
#include "apps/planner/assembly/parts.h"
#include "nef/base/monitor.h"
#include "nef/distance/distance.h"
#include "nef/polyhedron.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::planner {

/// Where two parts overlap.
struct Interference {
  Polyhedron region;                     ///< the intersection of their interiors
  std::array<Rational3, 2> box;          ///< around it
  MeasuredVolume volume;                 ///< with a proven bound of its error
  std::optional<Rational> exact_volume;  ///< if asked for, or if it is short anyway
};

/// What holds between two parts.
struct PairVerdict {
  std::size_t a = 0;
  std::size_t b = 0;  ///< larger than a
  /// How they stand to each other, and the nearest points: a common point if they touch, a point of the region's
  /// closure if they overlap.
  Distance distance;
  std::optional<Interference> interference;            ///< if they overlap
  std::optional<std::array<std::string, 2>> touching;  ///< if they touch: the item of each there, "vertex 3"
};

/// Whether a part can be taken away by translations while all others rest.
struct PartVerdict {
  enum class Status : std::uint8_t {
    kOverlapping,  ///< it overlaps another part; nothing is said of its motions
    kRemovable,    ///< it leaves along a straight line, however far: `direction`
    kStuck,        ///< it cannot begin to move: `first` has the directions that are blocked, and by whom
    kUndecided     ///< it can begin to move, but leaves in none of the directions tried (take_apart decides it)
  };
  Status status = Status::kUndecided;
  std::optional<Rational3> direction;
  FreeDirections first;
};

/// "overlapping", "removable", "stuck" or "undecided": how reports and Python spell it.
const char* status_name(PartVerdict::Status status);

/// About all pairs, in order, and all parts.
struct PartsVerdict {
  std::vector<PairVerdict> pairs;
  std::vector<PartVerdict> parts;

  /// True if some parts overlap.
  [[nodiscard]] bool interferes() const;
  /// The pair with the smallest gap, of those that have one.
  [[nodiscard]] std::optional<std::size_t> smallest_gap() const;
};

/// How parts are judged.
struct VerdictOptions {
  bool exact_volumes = false;  ///< rational volumes whatever their size: they may have thousands of digits
  Monitor monitor;
};

/// Judges parts at their places. Exact but for volumes. O(n log n) for each pair whose boxes meet or which is near, a
/// Boolean for each pair that overlaps, and for each part projections along some ten directions: 50 to 100 ms for two
/// parts of 1000 triangles.
PartsVerdict verdict(const Assembly& assembly, const VerdictOptions& options = {});

}  // namespace nef::planner
