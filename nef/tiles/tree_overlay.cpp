// SPDX-License-Identifier: Apache-2.0
//
// A recursion over both trees at once. A region is done without looking at tiles if one of the sets is uniform there or
// both share the node. If either tree is cut there, both are cut by that plane and the sides are done separately; a
// small second operand is handed on uncut, since a tile drops what lies beyond its walls. Two leaves are overlaid by a
// Boolean operation of complexes. Afterwards a node whose sides are unchanged is the old node, and two leaves that have
// become small are glued. A leaf that has not been cut yet is halved only where the second operand is, so a small step
// does not pay for cutting all of it. On several threads, the first 256 nodes are split on one thread and their
// subtrees are distributed.
#include "nef/tiles/tree_overlay.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "nef/base/threads/parallel.h"
#include "nef/tiles/cuts/cutter.h"
#include "nef/tiles/seams/seam_glue.h"

namespace nef {
namespace {

using Kind = TileNode::Kind;

// What a tree becomes if every mark x becomes f[x].
TileRef remarked(const TileRef& tree, const std::array<bool, 2>& f) {
  if (f[0] == f[1]) return uniform_leaf(f[0] ? 1 : 0);
  return f[0] ? tree.complement() : tree;
}

bool reaches_infinity(const Box& box) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return std::any_of(box.low.begin(), box.low.end(), [](double x) { return x == -kInfinity; }) ||
         std::any_of(box.high.begin(), box.high.end(), [](double x) { return x == kInfinity; });
}

class TreeOverlay {
 public:
  TreeOverlay(const TruthTable& f, const Tiling& tiling) : f_(f), tiling_(tiling) {}

  // What is left to be done for a region.
  struct Task {
    TileRef a;
    TileRef b;
    bool whole = true;  // b reaches exactly as far as the region; otherwise it may reach farther
    Region region;
  };
  // The same for the two sides of a plane.
  struct Split {
    const AxisPlane* plane = nullptr;  // of a node of one of the trees
    std::array<Task, 2> tasks;
  };

  // The answer where no tile needs to be looked at.
  [[nodiscard]] std::optional<TileRef> at_once(const Task& task) const {
    const auto& [a, b, whole, region] = task;
    if (b.node->kind == Kind::kUniform) {
      const bool in_b = b.node->mark != 0;
      return remarked(a, {value(false, in_b), value(true, in_b)});
    }
    if (a.node->kind == Kind::kUniform) {
      const bool in_a = a.node->mark != 0;
      const std::array<bool, 2> of_b{value(in_a, false), value(in_a, true)};
      if (whole || of_b[0] == of_b[1]) return remarked(b, of_b);
    }
    if (whole && a.node == b.node) {
      const bool complements = a.complemented != b.complemented;
      return remarked(a, {value(false, complements), value(true, !complements)});
    }
    return std::nullopt;
  }

  // Nothing for two leaves.
  [[nodiscard]] std::optional<Split> split(const Task& task, const Monitor& monitor) const {
    const bool cut_a = task.a.node->kind == Kind::kCut;
    if (!cut_a && task.b.node->kind != Kind::kCut) return std::nullopt;
    Split result;
    result.plane = cut_a ? &task.a.node->plane : &task.b.node->plane;
    const AxisPlane& plane = *result.plane;
    const std::array<TileRef, 2> of_a = cut_a ? children(task.a) : cut_leaf(task.a, plane, tiling_, monitor);
    std::array<TileRef, 2> of_b{task.b, task.b};
    bool whole = task.whole;
    if (task.b.node->kind == Kind::kCut) {
      of_b = cut_tree(task.b, plane, tiling_, monitor);
    } else if (const int side = plane.side(task.b.node->box); side != 0) {
      of_b[side < 0 ? 1 : 0] = beyond(*task.b.node, task.b.complemented, plane, side);
      whole = false;
    } else if (task.b.node->vertices <= kSmall && !reaches_infinity(task.b.node->box)) {
      whole = false;
    } else {
      of_b = cut_leaf(task.b, plane, tiling_, monitor);
    }
    for (std::size_t x = 0; x < 2; ++x) {
      result.tasks[x] = {of_a[x], of_b[x], whole, x == 0 ? task.region.below(plane) : task.region.above(plane)};
    }
    return result;
  }

  // The set of a task from those of its parts.
  [[nodiscard]] TileRef joined(const Task& task, const AxisPlane& plane, const std::array<TileRef, 2>& result,
                               const Monitor& monitor) const {
    if (task.a.node->kind == Kind::kCut && result == children(task.a)) return task.a;
    TileRef node = cut_node(plane, result[0], result[1]);
    return shrunk(node) ? tile_leaf(glue_tiles(node, task.region, monitor), tiling_.store) : node;
  }

  [[nodiscard]] TileRef run(const Task& task, const Monitor& monitor) const {
    monitor.check_interruption();
    if (std::optional<TileRef> known = at_once(task)) return *known;
    const std::optional<Split> parts = split(task, monitor);
    if (!parts) return leaves(task, monitor);
    const TileRef low = run(parts->tasks[0], monitor);
    return joined(task, *parts->plane, {low, run(parts->tasks[1], monitor)}, monitor);
  }

  // The same on several threads. The first tasks are split one after the other.
  [[nodiscard]] TileRef run_in_parallel(const Task& task, const Monitor& monitor) const {
    struct Node {
      Task task;
      const AxisPlane* plane = nullptr;
      std::array<std::size_t, 2> parts{};
      std::optional<TileRef> result;
    };
    std::vector<Node> nodes{{task, nullptr, {}, {}}};
    constexpr std::size_t kEnough = 256;
    for (std::size_t i = 0; i < nodes.size() && nodes.size() < kEnough; ++i) {
      nodes[i].result = at_once(nodes[i].task);
      if (nodes[i].result) continue;
      const std::optional<Split> parts = split(nodes[i].task, monitor);
      if (!parts) continue;
      nodes[i].plane = parts->plane;
      for (std::size_t x = 0; x < 2; ++x) {
        nodes[i].parts[x] = nodes.size();
        nodes.push_back({parts->tasks[x], nullptr, {}, {}});
      }
    }
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!nodes[i].result && nodes[i].plane == nullptr) open.push_back(i);
    }
    parallel_for(open.size(), monitor,
                 [&](std::size_t i, const Monitor& own) { nodes[open[i]].result = run(nodes[open[i]].task, own); });
    for (std::size_t i = nodes.size(); i-- > 0;) {
      Node& node = nodes[i];
      if (node.plane == nullptr) continue;
      node.result =
          joined(node.task, *node.plane, {*nodes[node.parts[0]].result, *nodes[node.parts[1]].result}, monitor);
    }
    return *nodes[0].result;
  }

 private:
  // What is so small meets tiles as it is; it is cheaper to let them drop what is beyond their walls than to cut it.
  static constexpr std::size_t kSmall = 64;

  [[nodiscard]] bool value(bool in_a, bool in_b) const { return f_[2U * (in_a ? 1U : 0U) + (in_b ? 1U : 0U)]; }

  // Two leaves that have become small are better off as one.
  [[nodiscard]] bool shrunk(const TileRef& tree) const {
    return tree.node->kind == Kind::kCut && tree.node->low.node->kind != Kind::kCut &&
           tree.node->high.node->kind != Kind::kCut && tree.node->vertices < tiling_.limit / 2;
  }

  [[nodiscard]] TileRef leaves(const Task& task, const Monitor& monitor) const {
    const TileRef& a = task.a;
    const TileRef& b = task.b;
    const Polyhedron first = a.node->kind == Kind::kUniform ? leaf_set(a, task.region, monitor) : a.node->set();
    const bool uncut = a.node->kind == Kind::kTile && a.node->uncut;
    if (uncut && touches_small_part(first.complex(), *b.node)) return cut_around(task, first.complex(), monitor);
    const auto marks = [&](LabelId x, LabelId y) {
      return static_cast<LabelId>(value((x != 0) != a.complemented, (y != 0) != b.complemented) ? 1 : 0);
    };
    Polyhedron result = overlay(first, b.node->set(), marks, monitor);
    if (&result.complex() == &first.complex()) return {a.node, false};
    const bool large = result.complex().vertex_count() > tiling_.limit;
    if (large && !uncut) return subdivided(result, tiling_, monitor);
    return tile_leaf(std::move(result), tiling_.store, large);
  }

  // True if cutting around the box of b is worth it.
  static bool touches_small_part(const Complex& a, const TileNode& b) {
    constexpr std::size_t kPart = 8;
    if (b.vertices > kSmall || reaches_infinity(b.box)) return false;
    std::size_t inside = 0;
    for (const VertexId v : a.vertex_ids()) {
      Box point;
      point.add_rounded(a.points.approximate(point_of(v)));
      if (point.overlaps(b.box)) ++inside;
    }
    return inside < a.vertex_count() / kPart;
  }

  // The result in an uncut leaf, cut in halves again and again where b is: what is left over shares with later
  // versions.
  [[nodiscard]] TileRef cut_around(const Task& task, const Complex& a, const Monitor& monitor) const {
    Cutter cutter(a.planes, tiling_, monitor);
    std::optional<Complex> loose;
    if (!a.has_box()) loose = cutter.loose(a);
    const std::optional<Cutter::Halved> halved = cutter.halve(loose ? *loose : a);
    if (halved) return cut_around(cutter, *halved, task, monitor);
    // What planes cannot separate is not tried again.
    return run({with_mark(task.a, tile_leaf(task.a.node->set(), tiling_.store)), task.b, task.whole, task.region},
               monitor);
  }

  // `task.a` stands for what the halves are of.
  [[nodiscard]] TileRef cut_around(Cutter& cutter, Cutter::Halved halved, const Task& task,
                                   const Monitor& monitor) const {
    monitor.check_interruption();
    const int side = halved.plane.side(task.b.node->box);
    std::array<TileRef, 2> result;
    for (std::size_t x = 0; x < 2; ++x) {
      Complex half = std::move(halved.halves[x]);
      Task part{task.a, task.b, false, x == 0 ? task.region.below(halved.plane) : task.region.above(halved.plane)};
      const bool touched = side == 0 || (side > 0) == (x == 1);
      if (touched) {
        if (std::optional<Cutter::Halved> quarters = cutter.halve(half)) {
          half = Complex();
          result[x] = cut_around(cutter, std::move(*quarters), part, monitor);
          continue;
        }
      } else {
        part.b = beyond(*task.b.node, task.b.complemented, halved.plane, side);
      }
      const bool uncut = !touched && half.vertex_count() > tiling_.limit;
      part.a = with_mark(task.a, cutter.leaf(std::move(half), uncut));
      result[x] = run(part, monitor);
    }
    return cut_node(halved.plane, result[0], result[1]);
  }

  // A part of a tree, complemented where that is.
  static TileRef with_mark(const TileRef& whole, const TileRef& part) {
    return whole.complemented ? part.complement() : part;
  }

  // What of b, whose boundary lies on one side of a plane, is on the other side.
  static TileRef beyond(const TileNode& b, bool complemented, const AxisPlane& plane, int side) {
    return uniform_leaf((mark_beyond(b, plane, -side) != 0) != complemented ? 1 : 0);
  }

  TruthTable f_;
  const Tiling& tiling_;
};

}  // namespace

TileRef overlay_trees(const TileRef& a, const TileRef& b, const TruthTable& f, const Tiling& tiling,
                      const Monitor& monitor) {
  const TreeOverlay overlay(f, tiling);
  const TreeOverlay::Task task{a, b, true, Region{}};
  return monitor.threads() == 1 ? overlay.run(task, monitor) : overlay.run_in_parallel(task, monitor);
}

std::array<TileRef, 2> cut_tree(const TileRef& tree, const AxisPlane& plane, const Tiling& tiling,
                                const Monitor& monitor) {
  if (tree.node->kind == Kind::kUniform) return {tree, tree};
  if (tree.node->kind == Kind::kTile) return cut_leaf(tree, plane, tiling, monitor);
  const AxisPlane& own = tree.node->plane;
  const auto [low, high] = children(tree);
  if (own == plane) return {low, high};
  if (own.axis != plane.axis) {
    const std::array<TileRef, 2> of_low = cut_tree(low, plane, tiling, monitor);
    const std::array<TileRef, 2> of_high = cut_tree(high, plane, tiling, monitor);
    return {cut_node(own, of_low[0], of_high[0]), cut_node(own, of_low[1], of_high[1])};
  }
  if (own.at < plane.at) {
    const std::array<TileRef, 2> of_high = cut_tree(high, plane, tiling, monitor);
    return {cut_node(own, low, of_high[0]), of_high[1]};
  }
  const std::array<TileRef, 2> of_low = cut_tree(low, plane, tiling, monitor);
  return {of_low[0], cut_node(own, of_low[1], high)};
}

}  // namespace nef
