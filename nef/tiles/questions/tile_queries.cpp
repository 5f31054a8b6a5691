// SPDX-License-Identifier: Apache-2.0
//
// A point that lies in one region is located in that tile. On walls between tiles, the local pyramids of the tiles that
// meet there are overlaid, each of which says nothing (kOutside) beyond its region, so together they are the local
// pyramid of the whole. Volumes are summed over tiles in chunks, in pairs, so that few sums have the denominators of
// many; boxes enclose the vertices at which the set has boundary.
#include "nef/tiles/questions/tile_queries.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "nef/base/threads/parallel.h"
#include "nef/complex/local_pyramid.h"
#include "nef/query/measures/extreme_points.h"
#include "nef/sphere_map/overlay.h"

namespace nef {
namespace {

using Kind = TileNode::Kind;

// Calls visit(leaf, region) for every leaf.
template <typename Visit>
void visit_leaves(const TileRef& tree, const Region& region, const Visit& visit) {
  if (tree.node->kind != Kind::kCut) {
    visit(tree, region);
    return;
  }
  const auto [low, high] = children(tree);
  visit_leaves(low, region.below(tree.node->plane), visit);
  visit_leaves(high, region.above(tree.node->plane), visit);
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

// Items of tiles have no numbers.
Location location_of_kind(Location::Kind kind, LabelId mark) {
  Location result;
  result.kind = kind;
  result.mark = mark;
  return result;
}

}  // namespace

void for_each_leaf(const TileRef& tree, const std::function<void(const TileRef& leaf, const Region& region)>& visit) {
  visit_leaves(tree, Region{}, visit);
}

Location PyramidInTiles::location(const Monitor& monitor) const {
  const SphereMapView view = map.view();
  const auto kind = is_vertex(planes, view, monitor) ? Location::Kind::kVertex
                    : !view.svertices.empty()        ? Location::Kind::kEdge
                    : !view.sloops.empty()           ? Location::Kind::kFacet
                                                     : Location::Kind::kVolume;
  return location_of_kind(kind, map.mark);
}

PyramidInTiles pyramid_in_tiles(const TileRef& tree, const Rational3& point, const Monitor& monitor) {
  PyramidInTiles result;
  SphereOverlay overlay;
  const LabelFunction whichever{LabelFunction::WhicheverIsInside{}};
  result.map.assign_trivial(kOutside);
  for_each_leaf_at(tree, Region{}, point, [&](const TileRef& leaf, const Region& region) {
    const Polyhedron set = leaf_set(leaf, region, monitor);
    SphereMapBuffer map = local_pyramid(set, point, monitor);
    intern_planes(set.complex().planes, result.planes, map);
    SphereMapBuffer joined;
    overlay.overlay(result.planes, result.map.view(), map.view(), whichever, joined, monitor);
    result.map = std::move(joined);
  });
  return result;
}

Location locate_in_tiles(const TileRef& tree, const Rational3& point, const Monitor& monitor) {
  std::vector<TileRef> leaves;
  for_each_leaf_at(tree, Region{}, point, [&](const TileRef& leaf, const Region&) { leaves.push_back(leaf); });
  if (leaves.size() > 1) return pyramid_in_tiles(tree, point, monitor).location(monitor);
  const TileRef& only = leaves.front();
  if (only.node->kind == Kind::kUniform) return {ItemRef(kOuterVolume), only.node->mark};
  const Location there = locate(only.node->set(), point, monitor);
  return location_of_kind(there.kind, (there.mark != 0) != only.complemented ? 1 : 0);
}

namespace {

using Corners = std::array<Rational3, 2>;

void enclose(std::optional<Corners>& box, const Corners& other) {
  if (!box) {
    box = other;
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    (*box)[0][axis] = std::min((*box)[0][axis], other[0][axis]);
    (*box)[1][axis] = std::max((*box)[1][axis], other[1][axis]);
  }
}

// `set`: what its node holds, if it is a tile.
std::optional<Rational> volume_of_set(const TileRef& leaf, const Polyhedron& set, const Region& region) {
  if (leaf.node->kind != Kind::kUniform) return volume(leaf.complemented ? complement(set) : set);
  if (leaf.node->mark == 0) return Rational(0);
  if (!bounded(region)) return std::nullopt;
  return extent(region, 0) * extent(region, 1) * extent(region, 2);
}

// Nothing if a vertex lies at infinity.
std::optional<Corners> box_of_tile(const Complex& c, const Monitor& monitor) {
  ExtremePoints extreme(c.points, monitor);
  BoundaryVertices has_boundary_at(c);
  for (const VertexId v : c.vertex_ids()) {
    if (!has_boundary_at(v)) continue;
    if (!c.points.finite(point_of(v))) return std::nullopt;
    extreme.add(point_of(v));
  }
  return extreme.box();  // a tile has boundary
}

// Two by two, so that few sums have the denominators of many.
Rational sum_of(std::vector<Rational> parts) {
  for (; parts.size() > 1; parts.resize((parts.size() + 1) / 2)) {
    for (std::size_t i = 0; 2 * i < parts.size(); ++i) {
      parts[i] = 2 * i + 1 < parts.size() ? Rational(parts[2 * i] + parts[2 * i + 1]) : parts[2 * i];
    }
  }
  return parts.empty() ? Rational(0) : parts.front();
}

}  // namespace

std::optional<Rational> volume_of_leaf(const TileRef& leaf, const Region& region) {
  return volume_of_set(leaf, leaf.node->kind == Kind::kUniform ? Polyhedron() : leaf.node->set(), region);
}

ExtentOfTiles extent_of_tiles(const TileRef& tree, bool with_volume, bool with_box, const Monitor& monitor) {
  std::vector<std::pair<TileRef, Region>> leaves;
  visit_leaves(tree, Region{},
               [&leaves](const TileRef& leaf, const Region& region) { leaves.emplace_back(leaf, region); });
  std::atomic<bool> finite = with_volume;
  std::atomic<bool> bounded = true;
  constexpr std::size_t kChunk = 16;
  struct Part {
    Rational volume;
    std::optional<Corners> box;
  };
  std::vector<Part> parts((leaves.size() + kChunk - 1) / kChunk);
  parallel_for(parts.size(), monitor, [&](std::size_t chunk, const Monitor& own) {
    own.check_interruption();
    Part& part = parts[chunk];
    for (std::size_t i = chunk * kChunk; i < std::min(leaves.size(), (chunk + 1) * kChunk); ++i) {
      const auto& [leaf, region] = leaves[i];
      const Polyhedron set = leaf.node->kind == Kind::kUniform ? Polyhedron() : leaf.node->set();
      if (finite) {
        const std::optional<Rational> volume = volume_of_set(leaf, set, region);
        if (volume) part.volume += *volume;
        if (!volume) finite = false;
      }
      if (with_box && bounded && leaf.node->kind != Kind::kUniform) {
        const std::optional<Corners> box = box_of_tile(set.complex(), own);
        if (box) enclose(part.box, *box);
        if (!box) bounded = false;
      }
    }
  });
  ExtentOfTiles result;
  result.bounded = bounded;
  if (finite) {
    std::vector<Rational> volumes;
    for (Part& part : parts) volumes.push_back(std::move(part.volume));
    result.volume = sum_of(std::move(volumes));
  }
  for (const Part& part : parts) {
    if (part.box) enclose(result.box, *part.box);
  }
  return result;
}

}  // namespace nef
