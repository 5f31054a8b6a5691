// SPDX-License-Identifier: Apache-2.0
//
// The range of motion of a mechanism with one moving part, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/mechanism/joint.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What holds between the moving part and the others at a joint's value.
enum class RangeStatus : std::uint8_t {
  kFree,       ///< they have no point in common
  kTouching,   ///< they have, but no interiors overlap
  kColliding,  ///< interiors overlap
  kUndecided   ///< four-bar linkages: too near to an end for doubles; screws: where several contacts are too near
};

/// "free", "touching", "colliding" or "undecided": how reports and Python spell it.
const char* status_name(RangeStatus status);

/// Two items that touch at the end of a part of the range.
struct ContactPair {
  std::string moving;     ///< of the moving part: "vertex 3", "edge 5", "facet 2"
  std::size_t fixed = 0;  ///< which of the others
  std::string of_fixed;   ///< its item
};

/// An end of a part of the range.
struct RangeEnd {
  QuadraticRoot value;  ///< exact, but for most ends of a screw, and next to an undecided part, where it is a bound
  /// Of a screw, where it is not exact: two turns 2^-64 apart that enclose it, of which `value` is the first one.
  std::optional<std::array<Rational, 2>> between;
  std::vector<ContactPair> stops;  ///< items that touch there, if something changes there
};

/// A maximal interval of values with one status, or one value that differs from those on both sides. What is free or
/// colliding is open, what touches is closed: ends that two parts share belong to the one that touches.
struct RangePart {
  RangeStatus status = RangeStatus::kFree;
  RangeEnd from;
  RangeEnd to;
};

/// The values of a joint that are free, touch or collide.
struct RangeOfMotion {
  std::vector<RangePart> parts;  ///< in order, covering the mechanism's range
  std::size_t cells = 0;         ///< that the range was cut into
  std::size_t events = 0;        ///< values at which something might have changed
};

/// The whole range of the mechanism. Cells of values in which hulls (motion_cell.h) prove that nothing touches, or that
/// something collides all the time, are done; in the others all contact events (contact_events.h) of the pieces that
/// come near are found, and each value between two of them is checked exactly, as are the events themselves. So hinges
/// and sliders are decided completely. The events of a screw are transcendental, unless they are at a multiple of 30 or
/// 45 degrees or do not depend on its way: they are enclosed in intervals 2^-64 wide, each the only zero of its
/// product, and what holds there follows from both sides. Undecided are other values at which bodies only graze, or at
/// which different products may have a common zero. Four-bar linkages, whose contact is algebraic of a high degree, are
/// bisected until what is undecided is as narrow as doubles allow, some 1e-9 of a quarter, or there are 8000 cells in a
/// 16th of a quarter. Throws InputError if the bars of a linkage do not meet in all of the range.
RangeOfMotion range_of_motion(const Mechanism& mechanism, const Monitor& monitor = {});

}  // namespace nef::planner
