// SPDX-License-Identifier: Apache-2.0
//
// Whether two sets have a common point, one of them moved by a translation, without making their intersection.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/item_ref.h"
#include "nef/forward.h"
#include "nef/number/approximation.h"
#include "nef/number/number.h"

namespace nef {

struct MeetingSets;

/// Answers for many translations of the same two sets. Both are put into trees of boxes once; a question moves points
/// of B where the sets are near each other, and stops at the first common point. May be asked from several threads at
/// once.
class IntersectionQuery {
 public:
  /// Keeps copies of both sets (which are O(1)). O(n log n) for bounded sets.
  IntersectionQuery(const Polyhedron& a, const Polyhedron& b);

  /// True if some point of A is also in B + translation. Openness counts: a closed and an open set that touch have no
  /// common point. Bounded sets: O(k log n) for k pairs of an edge and a facet whose boxes meet, and one point location
  /// for each connected part of a boundary that touches nothing; otherwise one Boolean operation.
  [[nodiscard]] bool meet(const Rational3& translation, const Monitor& monitor = {}) const;

  /// Where the boundaries of A and B + translation touch, if the two have no common point; nothing if they have one.
  /// For each vertex of the arrangement of both boundaries that lies on both, the item of A and the item of B that
  /// contain it: a vertex and any item, or an edge that crosses an edge or a facet; each pair once, edges named by the
  /// smaller halfedge.
  /// Both sets must be bounded. O(k log n) as `meet`.
  [[nodiscard]] std::optional<std::vector<std::array<ItemRef, 2>>> contacts(const Rational3& translation = {},
                                                                            const Monitor& monitor = {}) const;

  /// Pairs of an edge and a facet that crossed lately, which are likely to cross at the next translation, too.
  class Crossings {
   public:
    Crossings() = default;

   private:
    friend class IntersectionQuery;
    struct Pair {
      std::uint32_t of_edge = 0;  // 0: an edge of A and a facet of B; 1: the other way round
      std::uint32_t edge = 0, facet = 0;
    };
    std::vector<Pair> pairs_;  // the latest first
  };

  /// True only if at each translation within the errors an edge of one set crosses the inside of a facet of the other
  /// one: then the sets meet there, and a set with volume on one side of that facet, or beside that edge, does so with
  /// its inside. In doubles; false tells nothing. If not `search`, only pairs in `recent` are tried, O(1); else all,
  /// O(k log n) as above. `recent` is not to be shared between threads.
  [[nodiscard]] bool surely_cross(const Approximation3& translation, Crossings& recent, bool search = true) const;

 private:
  std::shared_ptr<const MeetingSets> sets_;
};

/// IntersectionQuery(a, b).meet(translation), for one question: true if A and B + translation have a common point.
bool intersects(const Polyhedron& a, const Polyhedron& b, const Rational3& translation = {},
                const Monitor& monitor = {});

}  // namespace nef
