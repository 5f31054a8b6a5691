// SPDX-License-Identifier: Apache-2.0
//
// The public operations, in terms of trees: Booleans are `overlay_trees`, a complement is a flag at the root, maps that
// take axes to axes are applied tile by tile, and topological operations glue the set and cut it again.
#include "nef/tiles/tiled_polyhedron.h"

#include <utility>

#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/tiles/cuts/cutter.h"
#include "nef/tiles/import/union_in_tiles.h"
#include "nef/tiles/questions/tile_queries.h"
#include "nef/tiles/questions/tile_rays.h"
#include "nef/tiles/seams/seam_glue.h"
#include "nef/tiles/tree_overlay.h"

namespace nef {
namespace {

using Kind = TileNode::Kind;

constexpr TruthTable kUnion{false, true, true, true};
constexpr TruthTable kIntersection{false, false, false, true};
constexpr TruthTable kDifference{false, false, true, false};
constexpr TruthTable kSymmetricDifference{false, true, true, false};

TiledPolyhedron combine(const TiledPolyhedron& a, const TiledPolyhedron& b, const TruthTable& f,
                        const Monitor& monitor) {
  return {overlay_trees(a.tree(), b.tree(), f, a.tiling(), monitor), a.tiling()};
}

// A plain operand comes as one leaf, and is cut only where that pays.
TiledPolyhedron combine(const TiledPolyhedron& a, const Polyhedron& b, const TruthTable& f, const Monitor& monitor) {
  return {overlay_trees(a.tree(), tile_leaf(without_labels(b, monitor), nullptr), f, a.tiling(), monitor), a.tiling()};
}

TiledPolyhedron by_gluing(const TiledPolyhedron& a, Polyhedron (*change)(const Polyhedron&, const Monitor&),
                          const Monitor& monitor) {
  return TiledPolyhedron(change(a.polyhedron(monitor), monitor), a.tiling(), monitor);
}

// The axis that each axis is taken to; nothing if any is taken to none.
std::optional<std::array<std::size_t, 3>> axes_of(const AffineMap& map) {
  std::array<std::size_t, 3> to{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t found = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      if (map.linear[j][i] == 0) continue;
      to[i] = j;
      ++found;
    }
    if (found != 1) return std::nullopt;
  }
  return to;
}

TileRef transformed(const TileRef& tree, const AffineMap& map, const std::array<std::size_t, 3>& to,
                    const Tiling& tiling, const Monitor& monitor) {
  if (tree.node->kind == Kind::kUniform) return tree;
  if (tree.node->kind == Kind::kTile) {
    return {tile_leaf(transform(tree.node->set(), map, monitor), tiling.store).node, tree.complemented};
  }
  const AxisPlane& plane = tree.node->plane;
  const std::size_t axis = to[plane.axis];
  const Rational& factor = map.linear[axis][plane.axis];
  TileRef low = transformed(tree.node->low, map, to, tiling, monitor);
  TileRef high = transformed(tree.node->high, map, to, tiling, monitor);
  if (factor < 0) std::swap(low, high);
  const TileRef result =
      cut_node(AxisPlane(axis, factor * plane.at + map.translation[axis]), std::move(low), std::move(high));
  return tree.complemented ? result.complement() : result;
}

}  // namespace

TiledPolyhedron::TiledPolyhedron() : TiledPolyhedron(uniform_leaf(0), Tiling{}) {}

TiledPolyhedron::TiledPolyhedron(const Polyhedron& set, const Tiling& tiling, const Monitor& monitor)
    : TiledPolyhedron(subdivided(without_labels(set, monitor), tiling, monitor), tiling) {}

TiledPolyhedron::TiledPolyhedron(const Polyhedron& set)
    : TiledPolyhedron(set, tiling_for(set.complex().vertex_count())) {}

TiledPolyhedron::TiledPolyhedron(std::span<const Polyhedron> pieces, const Tiling& tiling, const Monitor& monitor)
    : TiledPolyhedron(union_in_tiles({.count = static_cast<std::uint32_t>(pieces.size()),
                                      .set = [pieces](std::uint32_t i, const Monitor&) { return pieces[i]; }},
                                     tiling, kSetsOfARegion, monitor)) {}

TiledPolyhedron::TiledPolyhedron(TileRef root, const Tiling& tiling)
    : root_(std::make_shared<const TileRef>(std::move(root))), tiling_(tiling) {}

std::size_t TiledPolyhedron::tile_count() const { return root_->node->tiles; }

std::size_t TiledPolyhedron::vertex_count() const { return root_->node->vertices; }

bool TiledPolyhedron::is_empty() const { return root_->node->kind == Kind::kUniform && root_->node->mark == 0; }

bool TiledPolyhedron::is_everything() const { return root_->node->kind == Kind::kUniform && root_->node->mark != 0; }

Polyhedron TiledPolyhedron::polyhedron(const Monitor& monitor) const { return glue_all_tiles(*root_, monitor); }

TiledPolyhedron unite(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor) {
  return combine(a, b, kUnion, monitor);
}
TiledPolyhedron unite(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  return combine(a, b, kUnion, monitor);
}
TiledPolyhedron intersect(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor) {
  return combine(a, b, kIntersection, monitor);
}
TiledPolyhedron intersect(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  return combine(a, b, kIntersection, monitor);
}
TiledPolyhedron subtract(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor) {
  return combine(a, b, kDifference, monitor);
}
TiledPolyhedron subtract(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  return combine(a, b, kDifference, monitor);
}
TiledPolyhedron symmetric_difference(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor) {
  return combine(a, b, kSymmetricDifference, monitor);
}
TiledPolyhedron symmetric_difference(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  return combine(a, b, kSymmetricDifference, monitor);
}

TiledPolyhedron overlay(const TiledPolyhedron& a, const TiledPolyhedron& b, const TruthTable& f,
                        const Monitor& monitor) {
  return combine(a, b, f, monitor);
}
TiledPolyhedron overlay(const TiledPolyhedron& a, const Polyhedron& b, const TruthTable& f, const Monitor& monitor) {
  return combine(a, b, f, monitor);
}

TiledPolyhedron complement(const TiledPolyhedron& a) { return {a.tree().complement(), a.tiling()}; }

TiledPolyhedron interior(const TiledPolyhedron& a, const Monitor& monitor) { return by_gluing(a, interior, monitor); }
TiledPolyhedron closure(const TiledPolyhedron& a, const Monitor& monitor) { return by_gluing(a, closure, monitor); }
TiledPolyhedron boundary(const TiledPolyhedron& a, const Monitor& monitor) { return by_gluing(a, boundary, monitor); }
TiledPolyhedron exterior(const TiledPolyhedron& a, const Monitor& monitor) { return by_gluing(a, exterior, monitor); }
TiledPolyhedron regularize(const TiledPolyhedron& a, const Monitor& monitor) {
  return by_gluing(a, regularize, monitor);
}

TiledPolyhedron transform(const TiledPolyhedron& a, const AffineMap& map, const Monitor& monitor) {
  const std::optional<std::array<std::size_t, 3>> to = axes_of(map);
  if (!to || a.tree().node->kind != Kind::kCut) {
    return TiledPolyhedron(transform(a.polyhedron(monitor), map, monitor), a.tiling(), monitor);
  }
  return {transformed(a.tree(), map, *to, a.tiling(), monitor), a.tiling()};
}

bool equal(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor) {
  return symmetric_difference(a, b, monitor).is_empty();
}

Location locate(const TiledPolyhedron& a, const Rational3& point, const Monitor& monitor) {
  return locate_in_tiles(a.tree(), point, monitor);
}

bool contains(const TiledPolyhedron& a, const Rational3& point, const Monitor& monitor) {
  return locate(a, point, monitor).mark != 0;
}

std::optional<RayHit> shoot_ray(const TiledPolyhedron& a, const Rational3& origin, const Rational3& direction,
                                const std::function<bool(const Location&)>& accept, const Monitor& monitor) {
  if (is_zero(direction)) throw InputError("a ray needs a direction other than 0,0,0");
  return first_hit_in_tiles(a.tree(), origin, direction, accept, monitor);
}

std::optional<Rational> volume(const TiledPolyhedron& a, const Monitor& monitor) {
  return extent_of_tiles(a.tree(), true, false, monitor).volume;
}

std::optional<std::array<Rational3, 2>> bounding_box(const TiledPolyhedron& a, const Monitor& monitor) {
  const ExtentOfTiles extent = extent_of_tiles(a.tree(), false, true, monitor);
  return extent.bounded ? extent.box : bounding_box(a.polyhedron(monitor), monitor);
}

VolumeAndBox volume_and_bounding_box(const TiledPolyhedron& a, const Monitor& monitor) {
  const ExtentOfTiles extent = extent_of_tiles(a.tree(), true, true, monitor);
  return {extent.volume, extent.bounded ? extent.box : bounding_box(a.polyhedron(monitor), monitor)};
}

Section section(const TiledPolyhedron& a, const Rational3& normal, const Rational& offset, const Monitor& monitor) {
  const TiledPolyhedron cut = intersect(a, plane_of_section(normal, offset, monitor), monitor);
  return section(cut.polyhedron(monitor), normal, offset, monitor);
}

}  // namespace nef
