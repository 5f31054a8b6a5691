// SPDX-License-Identifier: Apache-2.0
//
// Segments in doubles with bounds of their errors: where planes, boxes and cells meet them, on the safe side.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef::minkowski {

/// An interval of the parameter of a segment, 0 at its start and 1 at its end; empty if low > high.
struct Interval {
  double low = 0, high = 1;
};

/// A segment on the planes of two faces: an edge of a cell, or where faces of two cells cross.
struct Segment {
  Double3 from{}, to{};                                ///< the true ends are within `error` in each coordinate
  double error = 0;                                    ///< a length
  std::uint32_t f = 0, g = 0;                          ///< the faces
  std::uint32_t from_point = kNone, to_point = kNone;  ///< where it ends, if that is a candidate already
  std::vector<Interval> open;                          ///< what is not surely covered

  /// The point at a parameter, rounded.
  [[nodiscard]] Double3 at(double t) const {
    return {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2])};
  }
  /// A box around all of it.
  [[nodiscard]] Box box() const;
  /// A box around a part of it.
  [[nodiscard]] Box box_of(const Interval& part) const;
};

/// The form of a face's plane along a segment: at + t * slope, within `error` for t from 0 to 1.
struct FormOnSegment {
  double at = 0, slope = 0, error = 0;
  // Both ends' values are within slack + weight * error of the truth, and what is between them is a mean of the two;
  // the factor leaves room for the rounding of the slope and of the sum here. Asked for each face of each neighbour.
  FormOnSegment(const RoundedFace& face, const Segment& s)
      : at(face.value(s.from)), slope(face.value(s.to) - at), error(2 * (face.slack + face.weight * s.error)) {}

  /// True if the line of the segment surely meets the plane in one point.
  [[nodiscard]] bool surely_changes() const { return std::fabs(slope) > 2 * error; }
};

/// Which way an interval is rounded.
enum class Rounding : std::uint8_t { kInwards, kOutwards };

/// Narrows t to where at + t * slope < bound.
inline void keep_below(Interval& t, double at, double slope, double bound, Rounding rounding) {
  // A difference and a quotient are within 3u of the truth, relatively, and parameters that matter are between -1 and
  // 2: 7e-16 at most. The rest is room; what it costs is that coverings that meet within 1e-13 of a segment's length
  // leave a point between them, which is then asked about exactly.
  constexpr double kRounding = 1e-13;
  const double margin = rounding == Rounding::kInwards ? kRounding : -kRounding;
  if (slope > 0) {
    t.high = std::min(t.high, (bound - at) / slope - margin);
  } else if (slope < 0) {
    t.low = std::max(t.low, (bound - at) / slope + margin);
  } else if (!(at < bound)) {
    t.high = t.low - 1;
  }
}

/// Narrows t to where the segment may be in a box; false if that is nowhere.
bool clip_to_box(const Segment& s, const Box& box, Interval& t);

/// Subtracts the open interval `inside` from closed ones.
void subtract(std::vector<Interval>& open, const Interval& inside, std::vector<Interval>& scratch);

}  // namespace nef::minkowski
