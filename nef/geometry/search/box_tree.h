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
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
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
    return are_set((low_ <= other.high_) & (other.low_ <= high_));
  }

 private:
  // Vectors as g++ and clang have them: where a comparison holds, all bits of its lane are set.
  using Floats __attribute__((vector_size(16))) = float;
  using Ints __attribute__((vector_size(16))) = std::int32_t;
  using Words __attribute__((vector_size(16))) = std::int64_t;

  static bool are_set(Ints lanes) {
    const Words words = std::bit_cast<Words>(lanes);
    return (words[0] & words[1]) == -1;
  }

 public:
  /// A translation of boxes that lie within some bounds: whether a box, moved, overlaps another one. True if it does;
  /// true, too, if it all but does.
  class Moved {
   public:
    /// Each coordinate of the translation is within 2^-50 of the truth, relatively. A box is moved to both sides by
    /// what it, the translation and the sum of them may be off, 2^-24 of each; of what is out of the range of floats
    /// nothing is known.
    Moved(const Box& bounds, const std::array<double, 3>& by) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double sizes = std::fabs(bounds.low[i]) + std::fabs(bounds.high[i]) + std::fabs(by[i]);
        const bool is_known = sizes < 0x1p100;
        const double slack = is_known ? sizes * 0x1p-21 + 0x1p-120 : 0;
        low_[i] = is_known ? static_cast<float>(by[i] - slack) : -std::numeric_limits<float>::infinity();
        high_[i] = is_known ? static_cast<float>(by[i] + slack) : std::numeric_limits<float>::infinity();
      }
    }

    bool operator()(const RoughBox& box, const RoughBox& other) const {
      return are_set((box.low_ + low_ <= other.high_) & (other.low_ <= box.high_ + high_));
    }

   private:
    Floats low_{};
    Floats high_{};
  };

 private:
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
  /// Partly on the threads of `monitor`; the same tree on any number.
  explicit BoxTree(std::span<const Box> boxes, BoxSplit split = BoxSplit::kCells, const Monitor& monitor = {});

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

  /// Calls visit(i, j), i < j, once for every pair of boxes that overlap, in an order that depends only on the boxes.
  /// Descends into pairs of nodes, so boxes that lie apart are told apart in bulk. Pairs in one group are left out:
  /// `groups`, empty or the group of each box, kNoGroup if it is in none.
  template <typename Visit>
  void for_each_pair(Visit&& visit, std::span<const std::uint32_t> groups = {}) const;

  /// The same in parts, for several threads.
  class PairSearch;

  /// All boxes of a tree in floats.
  struct Rough {
    std::vector<RoughBox> nodes, boxes;
  };
  [[nodiscard]] Rough rough(const Monitor& monitor = {}) const;

  /// Calls visit(index of box, index of box of the other tree) for every two that meet(own box, other box) takes, which
  /// must take two boxes if it takes two inside them, until it returns false. Descends into pairs of nodes. In an order
  /// that depends only on the boxes. Asks about the boxes in floats, `own` and `others`, which are `rough()` of both
  /// trees.
  template <typename Meet, typename Visit>
  void for_each_pair_with(const Rough& own, const BoxTree& other, const Rough& others, Meet&& meet,
                          Visit&& visit) const {
    if (nodes_.empty() || other.nodes_.empty()) return;
    std::array<std::array<std::uint32_t, 2>, 3 * 2 * kDeepest> stack;
    std::size_t depth = 0;
    const auto push = [&](std::uint32_t m, std::uint32_t n) {
      stack[depth] = {m, n};  // moves on if it is to stay
      depth += meet(own.nodes[m], others.nodes[n]) ? 1 : 0;
    };
    push(0, 0);
    while (depth > 0) {
      const auto [m, n] = stack[--depth];
      const Node& a = nodes_[m];
      const Node& b = other.nodes_[n];
      if (a.count > 0 && b.count > 0) {
        for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
          if (!meet(own.boxes[i], others.nodes[n])) continue;
          for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
            if (meet(own.boxes[i], others.boxes[j]) && !visit(order_[i], other.order_[j])) return;
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

/// A search for pairs of boxes that overlap. May be shared between threads.
class BoxTree::PairSearch {
 public:
  /// The pairs of boxes below two nodes.
  using Part = std::array<std::uint32_t, 2>;

  /// The tree and the groups (see for_each_pair) must outlive it. O(n).
  explicit PairSearch(const BoxTree& tree, std::span<const std::uint32_t> groups = {}, const Monitor& monitor = {})
      : tree_(tree), groups_(groups), node_group_(tree.groups_of_nodes(groups)), rough_(tree.rough(monitor)) {}

  /// All pairs in about so many parts, or more, if there are as many; in the order of for_each_pair.
  [[nodiscard]] std::vector<Part> parts(std::size_t count) const {
    std::vector<Part> result;
    if (tree_.nodes_.empty()) return result;
    result.push_back({0, 0});
    bool is_split = true;
    while (is_split && result.size() < count) {
      is_split = false;
      std::vector<Part> next;
      for (const Part& part : result) {
        if (is_pair_of_leaves(part)) {
          next.push_back(part);
          continue;
        }
        is_split = true;
        std::array<Part, 4> below;
        std::size_t depth = 0;
        push_below(part, below, depth);
        while (depth > 0) next.push_back(below[--depth]);
      }
      result = std::move(next);
    }
    return result;
  }

  /// Calls visit(i, j), i < j, for the pairs of a part.
  template <typename Visit>
  void for_each(const Part& part, Visit&& visit) const {
    std::array<Part, 3 * 2 * kDeepest> stack;
    std::size_t depth = 0;
    push(part[0], part[1], stack, depth);
    while (depth > 0) {
      const Part at = stack[--depth];
      if (is_pair_of_leaves(at)) {
        visit_leaves(at, visit);
      } else {
        push_below(at, stack, depth);
      }
    }
  }

 private:
  [[nodiscard]] bool is_pair_of_leaves(const Part& part) const {
    return tree_.nodes_[part[0]].count > 0 && tree_.nodes_[part[1]].count > 0;
  }

  // What is found is put at the end, which moves on if it is to stay.
  template <std::size_t size>
  void push(std::uint32_t m, std::uint32_t n, std::array<Part, size>& stack, std::size_t& depth) const {
    stack[depth] = {m, n};
    const bool in_one = node_group_[m] == node_group_[n] && node_group_[m] != kNoGroup;
    depth += rough_.nodes[m].overlaps(rough_.nodes[n]) && !in_one ? 1 : 0;
  }

  template <std::size_t size>
  void push_below(const Part& part, std::array<Part, size>& stack, std::size_t& depth) const {
    const auto [m, n] = part;
    const Node& a = tree_.nodes_[m];
    const Node& b = tree_.nodes_[n];
    if (m == n) {
      push(a.first, a.first, stack, depth);
      push(a.first + 1, a.first + 1, stack, depth);
      push(a.first, a.first + 1, stack, depth);
    } else if (a.count > 0) {
      push(m, b.first, stack, depth);
      push(m, b.first + 1, stack, depth);
    } else if (b.count > 0) {
      push(a.first, n, stack, depth);
      push(a.first + 1, n, stack, depth);
    } else {
      for (const std::uint32_t i : {0U, 1U}) {
        for (const std::uint32_t j : {0U, 1U}) push(a.first + i, b.first + j, stack, depth);
      }
    }
  }

  template <typename Visit>
  void visit_leaves(const Part& leaves, Visit&& visit) const {
    const Node& a = tree_.nodes_[leaves[0]];
    const Node& b = tree_.nodes_[leaves[1]];
    std::array<std::array<std::uint32_t, 2>, kLeafSize * kLeafSize + 1> found;
    std::size_t count = 0;
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
      for (std::uint32_t j = &a == &b ? i + 1 : b.first; j < b.first + b.count; ++j) {
        found[count] = {i, j};
        count += rough_.boxes[i].overlaps(rough_.boxes[j]) ? 1 : 0;
      }
    }
    for (const auto& [i, j] : std::span(found).first(count)) {
      const std::uint32_t p = tree_.order_[i];
      const std::uint32_t q = tree_.order_[j];
      if (!groups_.empty() && groups_[p] == groups_[q] && groups_[p] != kNoGroup) continue;
      if (tree_.boxes_[i].overlaps(tree_.boxes_[j])) visit(std::min(p, q), std::max(p, q));
    }
  }

  const BoxTree& tree_;
  std::span<const std::uint32_t> groups_;
  std::vector<std::uint32_t> node_group_;
  Rough rough_;
};

template <typename Visit>
void BoxTree::for_each_pair(Visit&& visit, std::span<const std::uint32_t> groups) const {
  if (!nodes_.empty()) PairSearch(*this, groups).for_each({0, 0}, visit);
}

}  // namespace nef
