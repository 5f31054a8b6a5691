// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/tree_overlay.h"

#include <algorithm>
#include <limits>

#include "nef/base/interruption.h"
#include "nef/base/parallel.h"
#include "nef/tiles/cutter.h"
#include "nef/tiles/seam_glue.h"

namespace nef {
namespace {

using Kind = TileNode::Kind;

// What a tree becomes if every mark x becomes f[x].
TileRef remarked(const TileRef& tree, const std::array<bool, 2>& f) {
  if (f[0] == f[1]) return uniform_leaf(f[0] ? 1 : 0);
  return f[0] ? tree.complement() : tree;
}

class TreeOverlay {
 public:
  TreeOverlay(const TruthTable& f, const Tiling& tiling) : f_(f), tiling_(tiling) {}

  // `whole`: b reaches exactly as far as the region; otherwise it may reach farther.
  [[nodiscard]] TileRef run(const TileRef& a, const TileRef& b, bool whole, const Region& region,
                            unsigned threads) const {
    check_interruption();
    if (b.node->kind == Kind::kUniform) return beside_b(a, b.node->mark != 0);
    if (whole && a.node->kind == Kind::kUniform) return beside_a(a.node->mark != 0, b);
    if (whole && a.node == b.node) return with_itself(a, a.complemented != b.complemented);
    if (a.node->kind == Kind::kCut) return below_cut(a, b, whole, region, threads);
    if (b.node->kind == Kind::kCut) {
      const AxisPlane& plane = b.node->plane;
      const std::array<TileRef, 2> halves = cut_leaf(a, plane);
      return both(a, plane, halves, children(b), {true, true}, region, threads);
    }
    return leaves(a, b, region);
  }

 private:
  [[nodiscard]] bool value(bool in_a, bool in_b) const { return f_[2U * (in_a ? 1U : 0U) + (in_b ? 1U : 0U)]; }

  [[nodiscard]] TileRef beside_b(const TileRef& a, bool in_b) const {
    return remarked(a, {value(false, in_b), value(true, in_b)});
  }
  [[nodiscard]] TileRef beside_a(bool in_a, const TileRef& b) const {
    return remarked(b, {value(in_a, false), value(in_a, true)});
  }
  [[nodiscard]] TileRef with_itself(const TileRef& a, bool complements) const {
    return remarked(a, {value(false, complements), value(true, !complements)});
  }

  static std::array<TileRef, 2> children(const TileRef& tree) {
    if (!tree.complemented) return {tree.node->low, tree.node->high};
    return {tree.node->low.complement(), tree.node->high.complement()};
  }

  [[nodiscard]] TileRef below_cut(const TileRef& a, const TileRef& b, bool whole, const Region& region,
                                  unsigned threads) const {
    const AxisPlane& plane = a.node->plane;
    std::array<TileRef, 2> parts{b, b};
    std::array<bool, 2> exact{whole, whole};
    if (b.node->kind == Kind::kCut) {
      parts = cut_tree(b, plane);
    } else if (const int side = plane.side(b.node->box); side != 0) {
      const std::size_t beyond = side < 0 ? 1 : 0;
      const LabelId mark = mark_beyond(*b.node, plane, -side);
      parts[beyond] = uniform_leaf((mark != 0) != b.complemented ? 1 : 0);
      exact = {false, false};
    } else if (b.node->vertices <= kSmall && !unbounded(b.node->box)) {
      exact = {false, false};
    } else {
      parts = cut_leaf(b, plane);
    }
    return both(a, plane, children(a), parts, exact, region, threads);
  }

  // What is so small meets tiles as it is; it is cheaper to let them drop what is beyond their walls than to cut it.
  static constexpr std::size_t kSmall = 64;

  static bool unbounded(const Box& box) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return std::any_of(box.low.begin(), box.low.end(), [](double x) { return x == -kInfinity; }) ||
           std::any_of(box.high.begin(), box.high.end(), [](double x) { return x == kInfinity; });
  }

  [[nodiscard]] TileRef both(const TileRef& a, const AxisPlane& plane, const std::array<TileRef, 2>& of_a,
                             const std::array<TileRef, 2>& of_b, const std::array<bool, 2>& whole, const Region& region,
                             unsigned threads) const {
    std::array<TileRef, 2> result;
    const auto run_half = [&](std::size_t x) {
      result[x] = run(of_a[x], of_b[x], whole[x], x == 0 ? region.below(plane) : region.above(plane), threads);
    };
    parallel_for(2, threads, run_half);
    if (a.node->kind == Kind::kCut && result == children(a)) return a;
    TileRef node = cut_node(plane, result[0], result[1]);
    return shrunk(node) ? tile_leaf(glue_tiles(node, region)) : node;
  }

  // Two leaves that have become small are better off as one.
  [[nodiscard]] bool shrunk(const TileRef& tree) const {
    return tree.node->kind == Kind::kCut && tree.node->low.node->kind != Kind::kCut &&
           tree.node->high.node->kind != Kind::kCut && tree.node->vertices < tiling_.limit / 2;
  }

  [[nodiscard]] TileRef leaves(const TileRef& a, const TileRef& b, const Region& region) const {
    const Polyhedron first = a.node->kind == Kind::kUniform ? leaf_set(a, region) : a.node->set;
    const auto marks = [&](LabelId x, LabelId y) {
      return static_cast<LabelId>(value((x != 0) != a.complemented, (y != 0) != b.complemented) ? 1 : 0);
    };
    Polyhedron result = overlay(first, b.node->set, marks);
    if (&result.complex() == &first.complex()) return {a.node, false};
    return result.complex().vertex_count() > tiling_.limit ? subdivided(result, tiling_.limit)
                                                           : tile_leaf(std::move(result));
  }

  TruthTable f_;
  const Tiling& tiling_;
};

}  // namespace

TileRef overlay_trees(const TileRef& a, const TileRef& b, const TruthTable& f, const Tiling& tiling) {
  return TreeOverlay(f, tiling).run(a, b, true, Region{}, tiling.threads);
}

std::array<TileRef, 2> cut_tree(const TileRef& tree, const AxisPlane& plane) {
  if (tree.node->kind == Kind::kUniform) return {tree, tree};
  if (tree.node->kind == Kind::kTile) return cut_leaf(tree, plane);
  const auto child = [&tree](const TileRef& own) { return tree.complemented ? own.complement() : own; };
  const AxisPlane& own = tree.node->plane;
  const TileRef low = child(tree.node->low);
  const TileRef high = child(tree.node->high);
  if (own == plane) return {low, high};
  if (own.axis != plane.axis) {
    const std::array<TileRef, 2> of_low = cut_tree(low, plane);
    const std::array<TileRef, 2> of_high = cut_tree(high, plane);
    return {cut_node(own, of_low[0], of_high[0]), cut_node(own, of_low[1], of_high[1])};
  }
  if (own.at < plane.at) {
    const std::array<TileRef, 2> of_high = cut_tree(high, plane);
    return {cut_node(own, low, of_high[0]), of_high[1]};
  }
  const std::array<TileRef, 2> of_low = cut_tree(low, plane);
  return {of_low[0], cut_node(own, of_low[1], high)};
}

}  // namespace nef
