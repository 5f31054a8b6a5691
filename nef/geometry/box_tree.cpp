// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/box_tree.h"

#include <cmath>
#include <numeric>

namespace nef {
namespace {

constexpr std::uint32_t kLeafSize = 4;

// The middle of a box along an axis; infinite sides count as very far, so that they sort to the ends.
double centre(const Box& box, std::size_t axis) {
  const double low = std::max(box.low[axis], -1e300);
  const double high = std::min(box.high[axis], 1e300);
  return 0.5 * low + 0.5 * high;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(boxes.size()), boxes);
  boxes_.reserve(boxes.size());
  for (const std::uint32_t index : order_) boxes_.push_back(boxes[index]);
}

// Median split along the axis on which the centres spread most: depth is at most log2(n) + 1.
void BoxTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t last, std::span<const Box> boxes) {
  Box bounds;
  std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 3> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (std::uint32_t i = first; i < last; ++i) {
    const Box& box = boxes[order_[i]];
    bounds.add(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double c = centre(box, axis);
      low[axis] = std::min(low[axis], c);
      high[axis] = std::max(high[axis], c);
    }
  }
  nodes_[node].box = bounds;
  if (last - first <= kLeafSize) {
    nodes_[node].first = first;
    nodes_[node].count = last - first;
    return;
  }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  }
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double ca = centre(boxes[a], axis);
                     const double cb = centre(boxes[b], axis);
                     return ca != cb ? ca < cb : a < b;
                   });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, first, middle, boxes);
  build(children + 1, middle, last, boxes);
}

}  // namespace nef
