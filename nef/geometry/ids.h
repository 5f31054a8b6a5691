// SPDX-License-Identifier: Apache-2.0
//
// The indices of planes and points.
#pragma once

#include <compare>
#include <cstdint>

#include "nef/base/id.h"

namespace nef {

/// An oriented plane: twice its row in a PlaneTable, plus one if seen from its other side.
/// Two planes of one table are the same point set iff their rows are equal.
struct PlaneId {
  static constexpr std::uint32_t kNone = nef::kNone;
  std::uint32_t value = kNone;

  constexpr PlaneId() = default;
  constexpr explicit PlaneId(std::uint32_t v) : value(v) {}
  /// The plane of a row, seen from the side that its normal points to.
  static constexpr PlaneId of_row(std::uint32_t row) { return PlaneId{row << 1U}; }

  [[nodiscard]] constexpr std::uint32_t row() const { return value >> 1U; }
  [[nodiscard]] constexpr bool flipped() const { return (value & 1U) != 0; }
  [[nodiscard]] constexpr PlaneId opposite() const { return PlaneId{value ^ 1U}; }
  [[nodiscard]] constexpr PlaneId opposite_if(bool flip) const { return PlaneId{value ^ (flip ? 1U : 0U)}; }
  [[nodiscard]] constexpr PlaneId unflipped() const { return of_row(row()); }
  /// Another row's plane, flipped if this one is.
  [[nodiscard]] constexpr PlaneId in_row(std::uint32_t other) const { return PlaneId{other << 1U | (value & 1U)}; }
  [[nodiscard]] constexpr bool valid() const { return value != kNone; }
  constexpr auto operator<=>(const PlaneId&) const = default;
};

using PointId = Id<struct PointTag>;

/// A mark, as the core sees it: 0 and 1 are false and true; a LabeledPolyhedron interns values of
/// any other type as small numbers. See nef/complex/label.h.
using LabelId = std::uint16_t;

/// The mark of the space beyond an infimaximal box. It equals no other mark, so that the box is
/// never simplified away, and every Boolean function maps it to itself.
inline constexpr LabelId kOutside = 0xffffU;

}  // namespace nef
