// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/search/box_tree.h"

#include <bit>
#include <cmath>

#include "nef/base/threads/parallel.h"

namespace nef {
namespace {

// The middle of a box along an axis; infinite sides count as very far, so that they sort to the ends.
double centre(const Box& box, std::size_t axis) {
  const double low = std::max(box.low[axis], -1e300);
  const double high = std::min(box.high[axis], 1e300);
  return 0.5 * low + 0.5 * high;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes, BoxSplit split, const Monitor& monitor) {
  if (boxes.empty()) return;
  const Monitor own = for_vertices(boxes.size(), monitor);
  const std::vector<std::array<double, 3>> centres = vector_of(boxes.size(), own, [&](std::size_t i) {
    return std::array{centre(boxes[i], 0), centre(boxes[i], 1), centre(boxes[i], 2)};
  });
  std::vector<SpatialKey> keys;
  if (split == BoxSplit::kCells) {
    keys = spatial_keys(centres, own);
  } else {  // all in one cell
    keys.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) keys[i].index = i;
  }
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  split_cells(0, 0, keys, centres);
  order_ = vector_of(boxes.size(), own, [&](std::size_t i) { return keys[i].index; });
  boxes_ = vector_of(boxes.size(), own, [&](std::size_t i) { return boxes[order_[i]]; });
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

BoxTree::Rough BoxTree::rough(const Monitor& monitor) const {
  const Monitor own = for_vertices(boxes_.size(), monitor);
  return {vector_of(nodes_.size(), own, [this](std::size_t n) { return RoughBox(nodes_[n].box); }),
          vector_of(boxes_.size(), own, [this](std::size_t i) { return RoughBox(boxes_[i]); })};
}

// The indices of those below a node, which lie beside each other.
std::span<const std::uint32_t> BoxTree::boxes_of(std::uint32_t node) const {
  std::uint32_t first = node;
  while (nodes_[first].count == 0) first = nodes_[first].first;
  std::uint32_t last = node;
  while (nodes_[last].count == 0) last = nodes_[last].first + 1;
  const std::uint32_t begin = nodes_[first].first;
  return std::span(order_).subspan(begin, nodes_[last].first + nodes_[last].count - begin);
}

// That of all boxes in a node, if they are in one.
std::vector<std::uint32_t> BoxTree::groups_of_nodes(std::span<const std::uint32_t> groups) const {
  std::vector<std::uint32_t> result(nodes_.size(), kNoGroup);
  if (groups.empty()) return result;
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    const Node& node = nodes_[n];
    if (node.count == 0) {
      if (result[node.first] == result[node.first + 1]) result[n] = result[node.first];
      continue;
    }
    const std::span<const std::uint32_t> boxes = std::span(order_).subspan(node.first, node.count);
    const std::uint32_t group = groups[boxes[0]];
    if (std::all_of(boxes.begin(), boxes.end(), [&](std::uint32_t i) { return groups[i] == group; })) {
      result[n] = group;
    }
  }
  return result;
}

// A leaf if there are few. Otherwise two children after all nodes so far, the first one of them.
std::optional<std::uint32_t> BoxTree::children(std::uint32_t node, std::uint32_t first, std::size_t count) {
  if (count <= kLeafSize) {
    nodes_[node].first = first;
    nodes_[node].count = static_cast<std::uint32_t>(count);
    return std::nullopt;
  }
  const auto result = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = result;
  nodes_.resize(nodes_.size() + 2);
  return result;
}

// Where the cells of sorted keys differ first: into two halves of a cube. At most 64 times one after the other.
void BoxTree::split_cells(std::uint32_t node, std::uint32_t first, std::span<SpatialKey> keys,
                          std::span<const std::array<double, 3>> centres) {
  if (keys.front().cell == keys.back().cell) return split_medians(node, first, keys, centres);
  const std::optional<std::uint32_t> two = children(node, first, keys.size());
  if (!two) return;
  const int bit = std::bit_width(keys.front().cell ^ keys.back().cell) - 1;
  const auto upper = std::partition_point(keys.begin(), keys.end(),
                                          [bit](const SpatialKey& key) { return (key.cell >> bit & 1U) == 0; });
  const auto middle = static_cast<std::size_t>(upper - keys.begin());
  split_cells(*two, first, keys.first(middle), centres);
  split_cells(*two + 1, first + static_cast<std::uint32_t>(middle), keys.subspan(middle), centres);
}

// Boxes of one cell, as where others are very large or far away: in halves along the axis on which the centres spread
// most, at most log2(n) + 1 times one after the other.
void BoxTree::split_medians(std::uint32_t node, std::uint32_t first, std::span<SpatialKey> keys,
                            std::span<const std::array<double, 3>> centres) {
  const std::optional<std::uint32_t> two = children(node, first, keys.size());
  if (!two) return;
  std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 3> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const SpatialKey& key : keys) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], centres[key.index][axis]);
      high[axis] = std::max(high[axis], centres[key.index][axis]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  }
  const std::size_t middle = keys.size() / 2;
  std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(middle), keys.end(),
                   [&](const SpatialKey& a, const SpatialKey& b) {
                     const double x = centres[a.index][axis];
                     const double y = centres[b.index][axis];
                     return x != y ? x < y : a.index < b.index;
                   });
  split_medians(*two, first, keys.first(middle), centres);
  split_medians(*two + 1, first + static_cast<std::uint32_t>(middle), keys.subspan(middle), centres);
}

}  // namespace nef
