// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/intersection/item_tree.h"

#include <cmath>

#include "nef/complex/item_boxes.h"
#include "nef/number/approximation.h"

namespace nef::planner {

ItemTree::ItemTree(const Complex& complex) {
  std::vector<Box> boxes;
  items_.reserve(complex.facet_count());
  boxes.reserve(complex.facet_count());
  const auto push = [&](const ItemRef& item, const Box& box) {
    items_.push_back(item);
    boxes.push_back(box);
  };
  for (const FacetId f : complex.facets.ids()) {
    push(ItemRef(f), facet_box(complex, complex.facets[f]));
  }
  for (const HalfedgeId h : complex.bare_edges()) push(ItemRef(h), edge_box(complex, h));
  for (const VertexId v : complex.vertex_ids()) {
    const SphereMapView map = complex.sphere_map(v);
    if (!map.svertices.empty() || !map.sloops.empty()) continue;
    push(ItemRef(v), vertex_box(complex, v));
  }
  tree_ = BoxTree(boxes);
}

ItemTree::Reach::Reach(const Vector3d& a, const Vector3d& b) : from_(a), along_(b - a) {
  box_.add_rounded(to_array(a));
  box_.add_rounded(to_array(b));
  size_ = a.cwiseAbs() + b.cwiseAbs();
}

// Separating axes: those of the box, and their cross products with the segment's direction. With sizes s, the sums of
// the magnitudes of what a coordinate is made of, a component of the direction is off by 2u s (each end by u, their
// difference by u of itself), one of `off` by 3u s, one of `half` by 2u s. A product of two is off by 5u s s and rounds
// by u of at most s s / 2 (half is at most s / 2), two of them and their difference by 13u s s for the distance and 8u
// s s for the reach: less than 64. What is not a number separates nothing; products that overflow make the bound
// infinite, too; sizes below 1e-290 are enlarged, so that what vanishes in a coordinate, 2^-1074, is far below u s.
bool ItemTree::Reach::may_meet(const Box& box) const {
  if (!box.overlaps(box_)) return false;
  Vector3d off;
  Vector3d half;
  Vector3d size;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    off[i] = from_[i] - (box.low[k] + box.high[k]) / 2;
    half[i] = (box.high[k] - box.low[k]) / 2;
    size[i] = size_[i] + std::fabs(box.low[k]) + std::fabs(box.high[k]) + 1e-290;
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3;
    const Eigen::Index k = (i + 2) % 3;
    const double distance = std::fabs(along_[j] * off[k] - along_[k] * off[j]);
    const double reach = std::fabs(along_[j]) * half[k] + std::fabs(along_[k]) * half[j];
    if (distance > reach + 64 * kRoundingUnit * (size[j] * size[k]) + 1e-300) return false;
  }
  return true;
}

}  // namespace nef::planner
