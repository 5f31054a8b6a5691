// SPDX-License-Identifier: Apache-2.0
//
// Sets in tiles whose cuts are chosen to be awkward: through vertices, edges, facets and halves between them.
#pragma once

#include "nef/io/native/native_binary.h"
#include "nef/operation/canonical_order.h"
#include "nef/tiles/tiled_polyhedron.h"
#include "nef/tiles/tree_overlay.h"
#include "tests/laws/laws.h"

namespace nef::test {

/// A cut, as twice its coordinate.
struct Cut {
  std::size_t axis = 0;
  int twice = 0;
};
inline void showValue(const Cut& cut, std::ostream& out) { out << "xyz"[cut.axis] << "=" << cut.twice << "/2"; }

/// A tree of cuts in preorder: each splits a leaf, chosen by going down left or right as `way` tells.
struct Cuts {
  std::vector<std::pair<Cut, unsigned>> steps;
};
inline void showValue(const Cuts& cuts, std::ostream& out) {
  for (const auto& [cut, way] : cuts.steps) {
    showValue(cut, out);
    out << " (way " << way << ") ";
  }
}

inline rc::Gen<Cuts> some_cuts(std::size_t most, int grid = 3) {
  const auto cut = rc::gen::apply(
      [](std::size_t axis, int twice) {
        return Cut{axis, twice};
      },
      rc::gen::inRange<std::size_t>(0, 3), rc::gen::inRange(0, 2 * grid + 1));
  const auto step = rc::gen::pair(cut, rc::gen::inRange(0U, 256U));
  return rc::gen::map(rc::gen::mapcat(rc::gen::inRange<std::size_t>(1, most + 1),
                                      [step](std::size_t count) {
                                        return rc::gen::container<std::vector<std::pair<Cut, unsigned>>>(count, step);
                                      }),
                      [](std::vector<std::pair<Cut, unsigned>> steps) { return Cuts{std::move(steps)}; });
}

/// The tree cut along the plane in one of its leaves, where the plane goes through that leaf's region.
inline TileRef cut_once(const TileRef& tree, const AxisPlane& plane, unsigned way) {
  if (tree.node->kind != TileNode::Kind::kCut) {
    const auto halves = cut_tree(tree, plane, Tiling{}, {});
    // Kept apart, even where both sides are the same.
    TileNode node;
    node.kind = TileNode::Kind::kCut;
    node.plane = plane;
    node.low = halves[0];
    node.high = halves[1];
    node.vertices = node.low.node->vertices + node.high.node->vertices;
    node.tiles = node.low.node->tiles + node.high.node->tiles;
    return {std::make_shared<const TileNode>(std::move(node)), false};
  }
  TileNode node = *tree.node;
  const int order = cmp(plane.at, node.plane.at);
  const bool same_axis = plane.axis == node.plane.axis;
  if (same_axis && order == 0) return tree;
  const bool high = same_axis ? order > 0 : (way & 1U) != 0;
  TileRef& child = high ? node.high : node.low;
  child = cut_once(child, plane, way >> 1U);
  return {std::make_shared<const TileNode>(std::move(node)), tree.complemented};
}

inline Rational half(int twice) {
  Rational result(twice, 2);
  result.canonicalize();
  return result;
}

/// The set cut so.
inline TiledPolyhedron tiled(const Polyhedron& set, const Cuts& cuts, const Tiling& tiling = {}) {
  TileRef tree = tile_leaf(set, nullptr);
  for (const auto& [cut, way] : cuts.steps) tree = cut_once(tree, AxisPlane(cut.axis, half(cut.twice)), way);
  return {tree, tiling};
}

/// Fails the property unless the glued set is the plain one, byte for byte in canonical order.
inline void glued_is(const TiledPolyhedron& set, const Polyhedron& plain, const std::string& what) {
  const Polyhedron glued = set.polyhedron();
  same(glued, plain, what);
  if (native_binary(glued) != native_binary(in_canonical_order(plain))) RC_FAIL(what + ": other bytes");
}

/// Every leaf is valid, marked kOutside beyond its region.
inline void leaves_are_valid(const TileRef& tree, const std::string& what) {
  if (tree.node->kind == TileNode::Kind::kCut) {
    leaves_are_valid(tree.node->low, what);
    leaves_are_valid(tree.node->high, what);
  } else if (tree.node->kind == TileNode::Kind::kTile) {
    const std::string broken = validate(tree.node->set().complex());
    // The last of all checks, which says that a tile ends at its walls.
    const bool at_walls = broken.find("what is outside lies beyond an infimaximal box") != std::string::npos;
    if (!broken.empty() && !at_walls) RC_FAIL(what + ", a tile: " + broken);
  }
}

/// A small box at one of many places on a sphere of radius 10.
inline Polyhedron notch(int i) {
  const int x = 3 * i % 7 - 3;
  const int y = 5 * i % 11 - 5;
  return make_box({Rational(2 * x + 1, 2), Rational(y), Rational(7)}, {Rational(2 * x + 3, 2), Rational(y + 1), 11});
}

}  // namespace nef::test
