// SPDX-License-Identifier: Apache-2.0
//
// Where the plane of one face cuts through another face.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/cells/segment.h"

namespace nef::minkowski {

/// A segment through the inside of a face; its true ends are within `error` in each coordinate.
struct Chord {
  std::array<Double3, 2> point{};
  double error = 0;
};

/// Cuts faces. Not to be shared between threads.
class FaceCutter {
 public:
  /// Both must outlive the object.
  FaceCutter(const RoundedCells& rounded, ExactCells& exact) : rounded_(rounded), exact_(exact) {}

  /// The cut of a face with another one's plane; nothing if they are in one plane or if the plane meets the face in an
  /// edge, a vertex or not at all, which is decided exactly. O(corners).
  std::optional<Chord> chord(std::uint32_t face, std::uint32_t other);

 private:
  enum class Side : std::uint8_t { kOff, kThrough };
  Side find_sides(std::uint32_t face, std::uint32_t other);
  void add_crossing(const Double3& p, const Double3& q, double a, double b, double slack, Double3& point,
                    double& error) const;

  const RoundedCells& rounded_;
  ExactCells& exact_;
  std::vector<int> sides_;  // per corner of the face at hand
  std::vector<double> values_;
};

/// What of chord a may be in chord b, which is on the same line, as an interval of a's parameter; empty if nothing.
Interval overlap(const Chord& a, const Chord& b);

}  // namespace nef::minkowski
