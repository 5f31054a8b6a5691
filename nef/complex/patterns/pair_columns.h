// SPDX-License-Identifier: Apache-2.0
//
// Columns over shalfedges that hold one number for each pair of twins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nef/complex/ids.h"
#include "nef/geometry/ids.h"

namespace nef {

/// The planes of shalfedges: twins lie in one plane, oriented otherwise.
class PlaneColumn {
 public:
  [[nodiscard]] PlaneId operator[](SHalfedgeId half) const {
    return values_[pair_of(half)].opposite_if((half.index() & 1U) != 0);
  }
  [[nodiscard]] std::size_t size() const { return 2 * values_.size(); }

  /// The one of the even shalfedge of each pair.
  [[nodiscard]] std::vector<PlaneId>& pairs() { return values_; }
  [[nodiscard]] const std::vector<PlaneId>& pairs() const { return values_; }

 private:
  std::vector<PlaneId> values_;
};

/// The halffacets that shalfedges lie on: twins lie on the two sides of one facet.
class HalffacetColumn {
 public:
  [[nodiscard]] HalffacetId operator[](SHalfedgeId half) const {
    return HalffacetId{values_[pair_of(half)].index() ^ (half.index() & 1U)};
  }
  /// Sets the twin's, too.
  void set(SHalfedgeId half, HalffacetId value) {
    values_[pair_of(half)] = HalffacetId{value.index() ^ (half.index() & 1U)};
  }
  void assign(std::size_t halves, HalffacetId of_even) { values_.assign(halves / 2, of_even); }
  [[nodiscard]] std::size_t size() const { return 2 * values_.size(); }

  /// The one of the even shalfedge of each pair.
  [[nodiscard]] std::vector<HalffacetId>& pairs() { return values_; }
  [[nodiscard]] const std::vector<HalffacetId>& pairs() const { return values_; }

 private:
  std::vector<HalffacetId> values_;
};

}  // namespace nef
