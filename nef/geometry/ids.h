// SPDX-License-Identifier: Apache-2.0
//
// Typed 32-bit indices. Every element of the library is an index into a flat array of the object
// that owns it; an index means nothing without that object.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace nef {

/// A 32-bit index that cannot be mixed up with an index of another kind. `Tag` is never defined.
template <typename Tag>
struct Id {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::uint32_t value = kNone;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
  [[nodiscard]] constexpr bool valid() const { return value != kNone; }
  constexpr auto operator<=>(const Id&) const = default;
};

/// An oriented plane: twice its row in a PlaneTable, plus one if seen from its other side.
/// Two planes of one table are the same point set iff their rows are equal.
struct PlaneId {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::uint32_t value = kNone;

  constexpr PlaneId() = default;
  constexpr explicit PlaneId(std::uint32_t v) : value(v) {}
  [[nodiscard]] constexpr std::uint32_t row() const { return value >> 1U; }
  [[nodiscard]] constexpr bool flipped() const { return (value & 1U) != 0; }
  [[nodiscard]] constexpr PlaneId opposite() const { return PlaneId{value ^ 1U}; }
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
