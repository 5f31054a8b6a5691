// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <unordered_map>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/operand.h"

namespace nef {

/// Locates points of the other operand in some facets of one. Small facets are scanned; large ones get a tree over
/// those of their edges that a ray can meet when they are first asked, so that a query costs O(log n + edges met by a
/// ray). Several threads may ask at once.
class FacetLocator {
 public:
  /// For points within the bounds of `other`.
  FacetLocator(const Operand& operand, const Operand& other, const CommonTables& tables)
      : operand_(operand), other_(other), tables_(tables) {}

  /// Says which facets will be asked. To be called once, before.
  void expect(std::span<const FacetId> facets);

  /// The item of the (closed) facet that holds a point of its plane: the facet itself, an edge or
  /// a vertex of its boundary or an isolated vertex inside; kNone if the point lies outside.
  [[nodiscard]] ItemRef locate(FacetId facet, PointId point, const Monitor& monitor) const;

  /// The boundary edges of the facet (as halfedges of its corners) whose boxes meet `box`, which must lie within the
  /// bounds of the other operand but for where a ray goes.
  template <typename Visit>
  void for_each_edge(FacetId facet, const Box& box, Visit&& visit) const {
    const std::span<const SHalfedgeId> corners = corners_of(facet);
    if (corners.size() <= kSmall) {
      for (const SHalfedgeId corner : corners) visit(operand_.complex().corner_halfedge(corner));
    } else {
      const LazyTree& edges = tree(facet);
      edges.tree.for_each_overlap(box, [&](std::uint32_t i) { visit(edges.halfedges[i]); });
    }
  }

 private:
  static constexpr std::size_t kSmall = 24;
  [[nodiscard]] std::span<const SHalfedgeId> corners_of(FacetId facet) const {
    return operand_.complex().corners_of(facet);
  }
  struct LazyTree {
    std::once_flag once;
    BoxTree tree;
    std::vector<HalfedgeId> halfedges;  // of its boxes
  };
  const LazyTree& tree(FacetId facet) const;

  const Operand& operand_;
  const Operand& other_;
  const CommonTables& tables_;
  mutable std::unordered_map<FacetId, LazyTree> trees_;  // of all large facets that are expected
};

}  // namespace nef
