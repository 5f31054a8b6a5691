// SPDX-License-Identifier: Apache-2.0
//
// The facets of an operand that vertices and edges of the other one may meet, where very many facets have a vertex in
// common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/boolean/operand.h"
#include "nef/geometry/search/direction_tree.h"

namespace nef {

/// Some facets of an operand, found by vertices and edges. Around a vertex of high degree all boxes overlap, so facets
/// there are found by the directions in which they are seen from it (DirectionTree), and edges that end at that vertex
/// meet those in their own direction only. Other facets are found by their boxes.
class WideFans {
 public:
  WideFans() = default;

  /// Of these facets of the operand.
  /// O(n log n) for the facets at vertices of high degree, O(vertices) if there are none.
  WideFans(const Operand& operand, std::span<const FacetId> facets);

  /// True if no vertex has a high degree: then a tree of boxes does as well.
  [[nodiscard]] bool empty() const { return fans_.empty(); }

  /// Appends the places (in `facets`) of all facets that an edge with these ends (or a vertex: one) may meet,
  /// ascending, but for those that have an end of the edge in common with it and nothing else. `end_at[i]` is the
  /// vertex of this operand that end i is known to lie on, if there is one.
  void find(std::span<const Double3> ends, std::span<const VertexId> end_at, const Box& box,
            std::vector<std::uint32_t>& places) const;

 private:
  struct Fan {
    VertexId centre{0};
    Box box;
    std::vector<std::uint32_t> places;
    DirectionTree directions;
  };

  bool join(const Operand& operand, FacetId facet, std::uint32_t place, Fan& fan);

  std::vector<Fan> fans_;
  std::vector<Box> boxes_;            // of all facets
  std::vector<std::uint32_t> plain_;  // places of facets that are in no fan
  BoxTree plain_tree_;
};

}  // namespace nef
