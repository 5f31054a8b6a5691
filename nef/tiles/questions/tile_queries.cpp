// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/questions/tile_queries.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "nef/complex/local_pyramid.h"
#include "nef/query/measures/extreme_points.h"
#include "nef/sphere_map/overlay.h"

namespace nef {
namespace {

using Kind = TileNode::Kind;

// Calls visit(leaf, region) for every leaf.
template <typename Visit>
void for_each_leaf(const TileRef& tree, const Region& region, const Visit& visit) {
  if (tree.node->kind != Kind::kCut) {
    visit(tree, region);
    return;
  }
  const auto [low, high] = children(tree);
  for_each_leaf(low, region.below(tree.node->plane), visit);
  for_each_leaf(high, region.above(tree.node->plane), visit);
}

// The same for those whose regions hold the point.
template <typename Visit>
void for_each_leaf_at(const TileRef& tree, const Region& region, const Rational3& point, const Visit& visit) {
  if (tree.node->kind != Kind::kCut) {
    visit(tree, region);
    return;
  }
  const AxisPlane& plane = tree.node->plane;
  const int side = cmp(point[plane.axis], plane.at);
  const auto [low, high] = children(tree);
  if (side <= 0) for_each_leaf_at(low, region.below(plane), point, visit);
  if (side >= 0) for_each_leaf_at(high, region.above(plane), point, visit);
}

void intern_planes(const PlaneTable& from, PlaneTable& to, SphereMapBuffer& map) {
  for_each_plane(map, [&](PlaneId& plane) { plane = to.intern_from(from, plane); });
}

Rational extent(const Region& region, std::size_t axis) { return region.high[axis]->at - region.low[axis]->at; }

bool bounded(const Region& region) {
  const auto closed = [](const AxisPlane* wall) { return wall != nullptr; };
  return std::all_of(region.low.begin(), region.low.end(), closed) &&
         std::all_of(region.high.begin(), region.high.end(), closed);
}

}  // namespace

Location PyramidInTiles::location() const {
  const SphereMapView view = map.view();
  const auto kind = is_vertex(planes, view)   ? Location::Kind::kVertex
                    : !view.svertices.empty() ? Location::Kind::kEdge
                    : !view.sloops.empty()    ? Location::Kind::kFacet
                                              : Location::Kind::kVolume;
  return {kind, 0, map.mark};
}

PyramidInTiles pyramid_in_tiles(const TileRef& tree, const Rational3& point) {
  PyramidInTiles result;
  SphereOverlay overlay;
  const LabelFunction whichever{LabelFunction::WhicheverIsInside{}};
  result.map.assign_trivial(kOutside);
  for_each_leaf_at(tree, Region{}, point, [&](const TileRef& leaf, const Region& region) {
    const Polyhedron set = leaf_set(leaf, region);
    SphereMapBuffer map = local_pyramid(set, point);
    intern_planes(set.complex().planes, result.planes, map);
    SphereMapBuffer joined;
    overlay.overlay(result.planes, result.map.view(), map.view(), whichever, joined);
    result.map = std::move(joined);
  });
  return result;
}

Location locate_in_tiles(const TileRef& tree, const Rational3& point) {
  std::vector<TileRef> leaves;
  for_each_leaf_at(tree, Region{}, point, [&](const TileRef& leaf, const Region&) { leaves.push_back(leaf); });
  if (leaves.size() > 1) return pyramid_in_tiles(tree, point).location();
  const TileRef& only = leaves.front();
  if (only.node->kind == Kind::kUniform) return {Location::Kind::kVolume, 0, only.node->mark};
  const Location there = locate(only.node->set(), point);
  return {there.kind, 0, static_cast<LabelId>((there.mark != 0) != only.complemented ? 1 : 0)};
}

std::optional<Rational> volume_of_tiles(const TileRef& tree) {
  std::optional<Rational> sum = Rational(0);
  for_each_leaf(tree, Region{}, [&sum](const TileRef& leaf, const Region& region) {
    if (!sum) return;
    if (leaf.node->kind != Kind::kUniform) {
      const std::optional<Rational> part = volume(leaf_set(leaf, region));
      sum = part ? std::optional<Rational>(*sum + *part) : std::nullopt;
    } else if (leaf.node->mark != 0) {
      sum = bounded(region) ? std::optional<Rational>(*sum + extent(region, 0) * extent(region, 1) * extent(region, 2))
                            : std::nullopt;
    }
  });
  return sum;
}

std::optional<std::array<Rational3, 2>> bounds_of_tiles(const TileRef& tree, bool& is_bounded) {
  std::optional<std::array<Rational3, 2>> result;
  is_bounded = true;
  for_each_leaf(tree, Region{}, [&](const TileRef& leaf, const Region&) {
    if (leaf.node->kind == Kind::kUniform || !is_bounded) return;
    const Polyhedron set = leaf.node->set();
    const Complex& c = set.complex();
    ExtremePoints extreme(c.points);
    BoundaryVertices has_boundary_at(c);
    for (const VertexId v : c.vertex_ids()) {
      if (!has_boundary_at(v)) continue;
      if (!c.points.finite(point_of(v))) {
        is_bounded = false;
        return;
      }
      extreme.add(point_of(v));
    }
    const std::array<Rational3, 2> own = *extreme.box();  // a tile has boundary
    if (!result) {
      result = own;
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      (*result)[0][axis] = std::min((*result)[0][axis], own[0][axis]);
      (*result)[1][axis] = std::max((*result)[1][axis], own[1][axis]);
    }
  });
  return result;
}

}  // namespace nef
