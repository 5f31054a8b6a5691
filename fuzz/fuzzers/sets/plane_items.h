// SPDX-License-Identifier: Apache-2.0
//
// The vertices, edges, facets and volumes of a set that is a bit for each cell of an arrangement of planes, by
// arithmetic on signs and rationals alone.
#pragma once

#include <optional>
#include <vector>

#include "fuzz/fuzzers/sets/plane_cells.h"
#include "nef/polyhedron.h"

namespace nef::fuzz {

/// What kind of item each cell belongs to. The bits of the cells around a cell are a cone's: those directions along
/// which it does not change make a space, whose dimension is the item's.
class PlaneItems {
 public:
  /// Both must outlive this object. O(cells^2 planes^2).
  PlaneItems(const Cells& cells, const Bits& bits);

  [[nodiscard]] Location::Kind kind(std::size_t cell) const { return kinds_[cell]; }

  /// How many items there are of a kind: cells of it, joined where one is in the closure of another.
  [[nodiscard]] std::size_t count(Location::Kind kind) const;

  /// The volume of the set; nothing if it is infinite.
  [[nodiscard]] std::optional<Rational> volume() const;

  /// The first factor at which a ray meets something but a volume; 0 if it begins along such an item; nothing if it
  /// meets none.
  [[nodiscard]] std::optional<Rational> first_hit(const Rational3& origin, const Rational3& direction) const;

 private:
  [[nodiscard]] Location::Kind kind_around(std::size_t cell) const;
  [[nodiscard]] bool unchanged_along(std::size_t cell, const Rational3& direction) const;
  [[nodiscard]] std::size_t dimension(std::size_t cell) const;

  const Cells& cells_;
  const Bits& bits_;
  std::vector<std::vector<std::size_t>> star_;  // of each cell: those in whose closure it is
  std::vector<Location::Kind> kinds_;
};

}  // namespace nef::fuzz
