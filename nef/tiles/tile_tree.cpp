// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/tile_tree.h"

#include <algorithm>
#include <utility>

#include "nef/base/error.h"

namespace nef {
namespace {

std::shared_ptr<const TileNode> make_uniform(LabelId mark) {
  TileNode node;
  node.mark = mark;
  return std::make_shared<const TileNode>(std::move(node));
}

}  // namespace

TileRef TileRef::complement() const {
  if (node->kind == TileNode::Kind::kUniform) return uniform_leaf(node->mark == 0 ? 1 : 0);
  return {node, !complemented};
}

bool has_boundary(const SphereMapView& map) {
  // The centre of a point on the border of a region has the mark of the set there.
  const auto differs = [&map](const auto& items) {
    return std::any_of(items.begin(), items.end(),
                       [&map](const auto& item) { return item.mark != map.mark && item.mark != kOutside; });
  };
  return differs(map.sfaces) || differs(map.shalfedges) || differs(map.svertices) || differs(map.sloops);
}

bool BoundaryVertices::operator()(VertexId vertex) {
  // Marks of great circles are no part of a pattern.
  if (c_.vertices[vertex].sloops != c_.vertices[vertex.next()].sloops) return has_boundary(c_.sphere_map(vertex));
  std::uint8_t& known = known_[c_.vertices[vertex].pattern.index()];
  if (known == kUnknown) known = has_boundary(c_.sphere_map(vertex)) ? 1 : 0;
  return known != 0;
}

TileMeasure measure_tile(const Complex& complex) {
  TileMeasure result;
  BoundaryVertices has_boundary_at(complex);
  for (const VertexId v : complex.vertex_ids()) {
    if (!has_boundary_at(v)) continue;
    result.box.add_rounded(complex.points.approximate(point_of(v)));
    result.uniform = false;
  }
  if (result.uniform)
    result.mark = complex.vertex_count() == 0 ? complex.volumes[kOuterVolume].mark : complex.mark(VertexId{0});
  return result;
}

TileRef uniform_leaf(LabelId mark) {
  static const std::array<std::shared_ptr<const TileNode>, 2> kLeaves{make_uniform(0), make_uniform(1)};
  return {kLeaves[mark == 0 ? 0 : 1], false};
}

TileRef tile_leaf(Polyhedron set, const std::shared_ptr<TileStore>& store, bool uncut) {
  const TileMeasure measure = measure_tile(set.complex());
  if (measure.uniform) return uniform_leaf(measure.mark);
  TileNode node;
  node.kind = TileNode::Kind::kTile;
  node.box = measure.box;
  node.vertices = set.complex().vertex_count();
  node.tiles = 1;
  node.uncut = uncut;
  if (store) {
    node.stored = store->keep(std::move(set));
  } else {
    node.in_memory = std::move(set);
  }
  return {std::make_shared<const TileNode>(std::move(node)), false};
}

TileRef cut_node(const AxisPlane& plane, TileRef low, TileRef high) {
  if (low.node == high.node && low.node->kind == TileNode::Kind::kUniform) return low;
  TileNode node;
  node.kind = TileNode::Kind::kCut;
  node.plane = plane;
  node.vertices = low.node->vertices + high.node->vertices;
  node.tiles = low.node->tiles + high.node->tiles;
  node.low = std::move(low);
  node.high = std::move(high);
  return {std::make_shared<const TileNode>(std::move(node)), false};
}

std::array<TileRef, 2> children(const TileRef& cut) {
  if (!cut.complemented) return {cut.node->low, cut.node->high};
  return {cut.node->low.complement(), cut.node->high.complement()};
}

Polyhedron leaf_set(const TileRef& leaf, const Region& region, const Monitor& monitor) {
  if (leaf.node->kind == TileNode::Kind::kUniform) return Polyhedron(uniform_tile(region, leaf.node->mark, monitor));
  return leaf.complemented ? complement(leaf.node->set()) : leaf.node->set();
}

LabelId mark_beyond(const TileNode& tile, const AxisPlane& plane, int side) {
  const Polyhedron set = tile.set();
  const Complex& c = set.complex();
  if (!c.has_box()) return c.volumes[kOuterVolume].mark;
  // The region has corners beyond the plane, and there are no other vertices.
  VertexId extreme{0};
  for (const VertexId v : c.vertex_ids()) {
    const double more =
        c.points.approximate(point_of(v))[plane.axis] - c.points.approximate(point_of(extreme))[plane.axis];
    if (side * more > 0) extreme = v;
  }
  NEF_ASSERT(!has_boundary(c.sphere_map(extreme)));
  return c.mark(extreme);
}

}  // namespace nef
