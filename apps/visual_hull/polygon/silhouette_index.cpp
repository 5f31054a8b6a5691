// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/polygon/silhouette_index.h"

#include <cmath>

namespace nef::visual_hull {

SilhouetteIndex::SilhouetteIndex(const Silhouette& silhouette) {
  std::vector<nef::Box> boxes;
  for (const Ring& ring : silhouette.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2& a = ring[i];
      const Point2& b = ring[(i + 1) % ring.size()];
      edges_.push_back({&a, &b});
      nef::Box box;
      box.add_rounded({a.approximate[0], a.approximate[1], 0});
      box.add_rounded({b.approximate[0], b.approximate[1], 0});
      boxes.push_back(box);
    }
  }
  tree_ = nef::BoxTree(boxes);
}

Side SilhouetteIndex::locate(const Point2& point, const nef::Monitor& monitor) const {
  // Only edges that the ray to the right from the point may meet.
  nef::Box query;
  query.add_rounded({point.approximate[0], point.approximate[1], 0});
  query.high[0] = INFINITY;
  bool inside = false;
  bool boundary = false;
  tree_.for_each_overlap(query, [&](std::uint32_t i) {
    const Point2& a = *edges_[i][0];
    const Point2& b = *edges_[i][1];
    const int ya = compare_coordinate(a, point, 1);
    const int yb = compare_coordinate(b, point, 1);
    if (ya * yb > 0) return;
    if (on_segment(a, b, point, monitor)) boundary = true;
    if ((ya > 0) == (yb > 0)) return;
    if ((yb > 0) == (orientation(a, b, point, monitor) > 0)) inside = !inside;
  });
  if (boundary) return Side::kBoundary;
  return inside ? Side::kInside : Side::kOutside;
}

}  // namespace nef::visual_hull
