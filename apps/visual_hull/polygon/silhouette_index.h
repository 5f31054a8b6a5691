// SPDX-License-Identifier: Apache-2.0
//
// Fast exact questions to a silhouette.
#pragma once

#include "apps/visual_hull/polygon/edge_grid.h"
#include "apps/visual_hull/polygon/polygon.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::visual_hull {

/// Holds a reference to the silhouette.
class SilhouetteIndex {
 public:
  explicit SilhouetteIndex(const Silhouette& silhouette);

  /// As locate(silhouette, point), but only with the edges at the height of the point.
  [[nodiscard]] Side locate(const Point2& point, const nef::Monitor& monitor) const;

  /// Calls visit(from, to) for every edge whose box overlaps `box`.
  template <typename Visit>
  void visit_edges(const Rectangle& box, Visit&& visit) const {
    nef::Box query;
    query.low = {box.low[0], box.low[1], 0};
    query.high = {box.high[0], box.high[1], 0};
    tree_.for_each_overlap(query, [&](std::uint32_t i) { visit(*edges_[i][0], *edges_[i][1]); });
  }

 private:
  std::vector<std::array<const Point2*, 2>> edges_;
  nef::BoxTree tree_;
};

}  // namespace nef::visual_hull
