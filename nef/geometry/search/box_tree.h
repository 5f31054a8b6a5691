// SPDX-License-Identifier: Apache-2.0
//
// A bounding volume hierarchy over boxes of doubles. The boxes must enclose what they stand for (outward-rounded), so
// that a miss is a proof. Nodes stand in one array, the two children of a node beside each other, and the boxes in the
// order of the leaves, so that a query reads memory mostly forwards. Where all pairs are asked for, most of the time
// went into branches that nobody could foresee; there the tests are without branches, and in floats, four at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "nef/geometry/search/spatial_order.h"

namespace nef {

/// A closed axis-parallel box of doubles. Starts empty. Infinite bounds are allowed.
struct Box {
  std::array<double, 3> low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::infinity()};
  std::array<double, 3> high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};

  /// Adds a point whose true coordinates are within 2^-50 relative of these doubles.
  void add_rounded(const std::array<double, 3>& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double margin = (point[i] < 0 ? -point[i] : point[i]) * 0x1p-50 + 1e-300;
      const double slack = margin < std::numeric_limits<double>::infinity() ? margin : 0.0;
      low[i] = std::min(low[i], point[i] - slack);
      high[i] = std::max(high[i], point[i] + slack);
    }
  }
  void add(const Box& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  [[nodiscard]] bool overlaps(const Box& other) const {
    unsigned meet = 1;  // without branches, which nobody could foresee
    for (std::size_t i = 0; i < 3; ++i) {
      meet &= static_cast<unsigned>(low[i] <= other.high[i]) & static_cast<unsigned>(other.low[i] <= high[i]);
    }
    return meet != 0;
  }
};

/// A box in floats, to tell boxes apart in a few instructions. Rounding keeps the order of numbers, so boxes that
/// overlap still do; boxes that all but do may, too.
class RoughBox {
 public:
  RoughBox() = default;
  explicit RoughBox(const Box& box) {
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = rounded(box.low[i]);
      high_[i] = rounded(box.high[i]);
    }
  }

  [[nodiscard]] bool overlaps(const RoughBox& other) const {
    const Words words = std::bit_cast<Words>((low_ <= other.high_) & (other.low_ <= high_));
    return (words[0] & words[1]) == -1;
  }

 private:
  // Vectors as g++ and clang have them: where a comparison holds, all bits of its lane are set.
  using Floats __attribute__((vector_size(16))) = float;
  using Words __attribute__((vector_size(16))) = std::int64_t;

  // Numbers out of the range of floats become the last one in it.
  static float rounded(double x) { return static_cast<float>(std::clamp(x, -0x1p127, 0x1p127)); }

  Floats low_{};  // the fourth lanes are equal
  Floats high_{};
};

/// How a BoxTree is made: into halves of a cube, which is soon done, or into halves of the boxes along the axis on
/// which they spread most, which parts boxes better that overlap many others, or are flat, and pays where each of them
/// is asked for.
enum class BoxSplit : std::uint8_t { kCells, kMedians };

/// Static tree over n boxes: by cells O(n) to build as a rule, O(n log n) at most, O(log n + hits) expected for a
/// query.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Box> boxes, BoxSplit split = BoxSplit::kCells);

  /// Calls visit(index of box) for every box that overlaps `query`, in an order that depends
  /// only on the boxes.
  template <typename Visit>
  void for_each_overlap(const Box& query, Visit&& visit) const {
    for_each_if([&query](const Box& box) { return box.overlaps(query); }, visit);
  }

  /// Calls visit(index) for every box that `accept` takes; accept must take a box if it takes one
  /// inside it.
  template <typename Accept, typename Visit>
  void for_each_if(Accept&& accept, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, kDeepest> stack{};
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!accept(node.box)) continue;
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          if (accept(boxes_[i])) visit(order_[i]);
        }
      } else {
        stack[depth++] = node.first + 1;
        stack[depth++] = node.first;
      }
    }
  }

  /// Calls visit(i, j), i < j, once for every pair of boxes that overlap, in no particular order. Descends into
  /// pairs of nodes, so boxes that lie apart are told apart in bulk. Pairs in one group are left out: `groups`, empty
  /// or the group of each box, kNoGroup if it is in none.
  template <typename Visit>
  void for_each_pair(Visit&& visit, std::span<const std::uint32_t> groups = {}) const {
    if (nodes_.empty()) return;
    const std::vector<std::uint32_t> node_group = groups_of_nodes(groups);
    std::vector<RoughBox> nodes;
    nodes.reserve(nodes_.size());
    for (const Node& node : nodes_) nodes.emplace_back(node.box);
    const std::vector<RoughBox> boxes(boxes_.begin(), boxes_.end());
    // What is found is put at the end, which moves on if it is to stay.
    std::array<std::array<std::uint32_t, 2>, 3 * 2 * kDeepest> stack;  // of nodes
    std::size_t depth = 0;
    const auto push = [&](std::uint32_t m, std::uint32_t n) {
      stack[depth] = {m, n};
      const bool in_one = node_group[m] == node_group[n] && node_group[m] != kNoGroup;
      depth += nodes[m].overlaps(nodes[n]) && !in_one ? 1 : 0;
    };
    const auto in_one_group = [groups](std::uint32_t i, std::uint32_t j) {
      return !groups.empty() && groups[i] == groups[j] && groups[i] != kNoGroup;
    };
    std::array<std::array<std::uint32_t, 2>, kLeafSize * kLeafSize + 1> found;
    const auto visit_leaves = [&](const Node& a, const Node& b) {
      std::size_t count = 0;
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
        for (std::uint32_t j = &a == &b ? i + 1 : b.first; j < b.first + b.count; ++j) {
          found[count] = {i, j};
          count += boxes[i].overlaps(boxes[j]) ? 1 : 0;
        }
      }
      for (const auto& [i, j] : std::span(found).first(count)) {
        if (in_one_group(order_[i], order_[j])) continue;
        if (boxes_[i].overlaps(boxes_[j])) visit(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
      }
    };
    push(0, 0);
    while (depth > 0) {
      const auto [m, n] = stack[--depth];
      const Node& a = nodes_[m];
      const Node& b = nodes_[n];
      if (a.count > 0 && b.count > 0) {
        visit_leaves(a, b);
      } else if (m == n) {
        push(a.first, a.first);
        push(a.first + 1, a.first + 1);
        push(a.first, a.first + 1);
      } else if (a.count > 0) {
        push(m, b.first);
        push(m, b.first + 1);
      } else if (b.count > 0) {
        push(a.first, n);
        push(a.first + 1, n);
      } else {
        for (const std::uint32_t i : {0U, 1U}) {
          for (const std::uint32_t j : {0U, 1U}) push(a.first + i, b.first + j);
        }
      }
    }
  }

  /// Calls visit(index of box, index of box of the other tree) for every two that meet(own box, other box) takes, which
  /// must take two boxes if it takes two inside them, until it returns false. Descends into pairs of nodes. In an order
  /// that depends only on the boxes.
  template <typename Meet, typename Visit>
  void for_each_pair_with(const BoxTree& other, Meet&& meet, Visit&& visit) const {
    if (nodes_.empty() || other.nodes_.empty()) return;
    std::array<std::array<std::uint32_t, 2>, 3 * 2 * kDeepest> stack;
    std::size_t depth = 0;
    const auto push = [&](std::uint32_t m, std::uint32_t n) {
      if (meet(nodes_[m].box, other.nodes_[n].box)) stack[depth++] = {m, n};
    };
    push(0, 0);
    while (depth > 0) {
      const auto [m, n] = stack[--depth];
      const Node& a = nodes_[m];
      const Node& b = other.nodes_[n];
      if (a.count > 0 && b.count > 0) {
        for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
          if (!meet(boxes_[i], b.box)) continue;
          for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
            if (meet(boxes_[i], other.boxes_[j]) && !visit(order_[i], other.order_[j])) return;
          }
        }
      } else if (a.count > 0) {
        for (const std::uint32_t j : {1U, 0U}) push(m, b.first + j);
      } else if (b.count > 0) {
        for (const std::uint32_t i : {1U, 0U}) push(a.first + i, n);
      } else {
        for (const std::uint32_t i : {1U, 0U}) {
          for (const std::uint32_t j : {1U, 0U}) push(a.first + i, b.first + j);
        }
      }
    }
  }

  /// The group of each box, kNoGroup if it is in none: is_group(indices of boxes) is asked about the boxes of a node,
  /// of the root first, and about those of its children if it says no, as long as there are `least` of them.
  template <typename IsGroup>
  [[nodiscard]] std::vector<std::uint32_t> groups(std::size_t least, IsGroup&& is_group) const {
    std::vector<std::uint32_t> result(order_.size(), kNoGroup);
    if (nodes_.empty()) return result;
    std::array<std::uint32_t, kDeepest> stack{};
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t n = stack[--depth];
      const std::span<const std::uint32_t> boxes = boxes_of(n);
      if (boxes.size() < least) continue;
      if (is_group(boxes)) {
        for (const std::uint32_t i : boxes) result[i] = n;
      } else if (nodes_[n].count == 0) {
        stack[depth++] = nodes_[n].first + 1;
        stack[depth++] = nodes_[n].first;
      }
    }
    return result;
  }

  /// Stands for no group.
  static constexpr std::uint32_t kNoGroup = 0xffffffffU;

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// The box around everything; empty for an empty tree.
  [[nodiscard]] Box bounds() const { return nodes_.empty() ? Box{} : nodes_[0].box; }

 private:
  static constexpr std::uint32_t kLeafSize = 8;         // boxes, at most
  static constexpr std::size_t kDeepest = 64 + 32 + 2;  // nodes on a way down, at most

  struct Node {
    Box box;
    std::uint32_t first = 0;  // of the two children, or of the leaf's boxes
    std::uint32_t count = 0;  // 0 for inner nodes
  };
  [[nodiscard]] std::span<const std::uint32_t> boxes_of(std::uint32_t node) const;
  [[nodiscard]] std::vector<std::uint32_t> groups_of_nodes(std::span<const std::uint32_t> groups) const;
  std::optional<std::uint32_t> children(std::uint32_t node, std::uint32_t first, std::size_t count);
  void split_cells(std::uint32_t node, std::uint32_t first, std::span<SpatialKey> keys,
                   std::span<const std::array<double, 3>> centres);
  void split_medians(std::uint32_t node, std::uint32_t first, std::span<SpatialKey> keys,
                     std::span<const std::array<double, 3>> centres);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;  // in the order of the leaves
};

}  // namespace nef
