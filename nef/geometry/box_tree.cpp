// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/box_tree.h"

#include <cmath>

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
  if (boxes.empty()) return;
  std::vector<Entry> entries(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) entries[i].centre[axis] = centre(boxes[i], axis);
    entries[i].index = i;
  }
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  build(0, 0, entries);
  boxes_.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    order_[i] = entries[i].index;
    boxes_.push_back(boxes[order_[i]]);
  }
  // Bounds from the leaves upward: children come after their parents.
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) node.box.add(boxes_[i]);
    } else {
      node.box.add(nodes_[node.first].box);
      node.box.add(nodes_[node.first + 1].box);
    }
  }
}

// Median split along the axis on which the centres spread most: depth is at most log2(n) + 1.
void BoxTree::build(std::uint32_t node, std::uint32_t first, std::span<Entry> entries) {
  if (entries.size() <= kLeafSize) {
    nodes_[node].first = first;
    nodes_[node].count = static_cast<std::uint32_t>(entries.size());
    return;
  }
  std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 3> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Entry& entry : entries) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], entry.centre[axis]);
      high[axis] = std::max(high[axis], entry.centre[axis]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  }
  const std::size_t middle = entries.size() / 2;
  std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(middle), entries.end(),
                   [axis](const Entry& a, const Entry& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.index < b.index;
                   });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, first, entries.first(middle));
  build(children + 1, first + static_cast<std::uint32_t>(middle), entries.subspan(middle));
}

}  // namespace nef
