// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/partition/roadmap.h"

#include <algorithm>

#include "apps/planner/partition/portal_maker.h"
#include "apps/planner/partition/segment_walk.h"
#include "apps/planner/partition/space_tree.h"
#include "nef/base/error.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {
namespace {

// Offsets of a table of lists, from the list's owner of each entry.
template <typename ForEach>
void make_lists(std::size_t owners, std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& entries,
                const ForEach& for_each) {
  begin.assign(owners + 1, 0);
  for_each([&](std::uint32_t owner, std::uint32_t) { ++begin[owner + 1]; });
  for (std::size_t i = 0; i < owners; ++i) begin[i + 1] += begin[i];
  entries.resize(begin[owners]);
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for_each([&](std::uint32_t owner, std::uint32_t entry) { entries[next[owner]++] = entry; });
}

}  // namespace

Roadmap::Roadmap(const Complex& complex, const CellNumbering& cells, SpaceTree& tree, const Monitor& monitor,
                 const std::function<bool(CellId)>& selected)
    : complex_(&complex),
      cells_(&cells),
      tree_(&tree),
      walls_(complex, cells, tree, monitor, [&](CellId cell) { return cells.dimension(cell) == 2 && selected(cell); }) {
  p_ = PortalMaker(complex, cells, tree, walls_, selected, monitor).make();
  make_lists(tree.leaves().size() + cells.facet(FacetId{0}), zone_begin_, zone_portals_, [&](const auto& visit) {
    for (PortalId s = 0; s < p_.portals.size(); ++s) {
      for (const ZoneId zone : zones_of(s)) visit(zone, s);
    }
  });
  make_lists(tree.leaves().size(), leaf_wall_begin_, leaf_walls_, [&](const auto& visit) {
    for (std::uint32_t i = 0; i < walls_.walls().size(); ++i) {
      const Wall& wall = walls_.walls()[i];
      for (const LeafId leaf : {wall.on, wall.below, wall.above}) visit(leaf, i);
    }
  });
}

CellId Roadmap::cell_of(ZoneId zone) const {
  const auto leaves = static_cast<std::uint32_t>(tree_->leaves().size());
  return zone < leaves ? tree_->leaves()[zone].cell : zone - leaves;
}

Rational3 Roadmap::point(PortalId id) const {
  const Portal& portal = p_.portals[id];
  switch (portal.kind) {
    case Portal::Kind::kWall:
      return walls_.centre(walls_.walls()[portal.source]);
    case Portal::Kind::kSeam:
      return walls_.centre(walls_.seams()[portal.source]);
    case Portal::Kind::kVertex:
      return complex_->points.rational(point_of(VertexId{portal.source}));
    default: {
      const Rational3 a = complex_->points.rational(point_of(complex_->source(HalfedgeId{portal.source})));
      const Rational3 b = complex_->points.rational(point_of(complex_->target(HalfedgeId{portal.source})));
      return point_between(a, b, Rational(1, 2));
    }
  }
}

ZoneId Roadmap::zone_at(const ExactPoint& point) const {
  const LeafId leaf = tree_->leaf_at(point);
  const CellId cell = tree_->leaves()[leaf].cell;
  NEF_ASSERT(cell != kNoCell);
  if (cells_->dimension(cell) <= 1) return static_cast<ZoneId>(tree_->leaves().size()) + cell;
  if (cells_->dimension(cell) == 3 || tree_->leaves()[leaf].dimension == 2) return leaf;
  // On a seam inside a facet: take a leaf of the facet beside it.
  const Nudge n = Direction::normal(complex_->planes, complex_->facets[FacetId{cells_->index(cell)}].plane).integers();
  const Nudge u = across(n);
  const std::array<Nudge, 2> nudges{u, cross(n, u)};
  return tree_->leaf_at(point, nudges);
}

ZoneId Roadmap::zone_in(CellId cell) const {
  for (ZoneId zone = 0; zone < zone_count(); ++zone) {
    if (!portals_of(zone).empty() && cell_of(zone) == cell) return zone;
  }
  // No portal: the cell is a single leaf by itself.
  for (LeafId leaf = 0; leaf < tree_->leaves().size(); ++leaf) {
    if (tree_->leaves()[leaf].cell == cell && tree_->leaves()[leaf].dimension == cells_->dimension(cell)) return leaf;
  }
  NEF_ASSERT(cells_->dimension(cell) <= 1);
  return static_cast<ZoneId>(tree_->leaves().size()) + cell;
}

Rational3 Roadmap::step_off(const Wall& wall, LeafId leaf) const {
  const Rational3 centre = walls_.centre(wall);
  Rational3 far = centre;
  const Nudge n = Direction::normal(tree_->planes(), wall.plane).integers();
  const Integer largest = std::max({Integer(abs(n[0])), Integer(abs(n[1])), Integer(abs(n[2]))});
  for (std::size_t i = 0; i < 3; ++i) {
    Rational step(n[i], largest);
    step.canonicalize();
    far[i] += wall.above == leaf ? step : Rational(-step);
  }
  const ExactPoint a(centre);
  const ExactPoint b(far);
  Rational3 result = centre;
  walk_segment(*tree_, a, b, [&](const SegmentPart& part) {
    if (part.is_point) return true;
    const ExactSegment segment(tree_->planes(), a, b);
    result = segment.point(segment.exact(part.end) / 2);
    return false;
  });
  return result;
}

Rational3 Roadmap::interior_of_leaf(LeafId leaf) const {
  const std::span<const std::uint32_t> around{leaf_walls_.data() + leaf_wall_begin_[leaf],
                                              leaf_wall_begin_[leaf + 1] - leaf_wall_begin_[leaf]};
  NEF_ASSERT(!around.empty());
  const bool is_solid = tree_->leaves()[leaf].dimension == 3;
  const PlaneId first = walls_.walls()[around.front()].plane;
  const bool one_plane =
      std::all_of(around.begin(), around.end(), [&](std::uint32_t i) { return walls_.walls()[i].plane == first; });
  if (is_solid && one_plane) return step_off(walls_.walls()[around.front()], leaf);
  // Points inside different faces of a convex body: their mean is inside the body.
  std::vector<Rational3> centres;
  for (const std::uint32_t wall : around) centres.push_back(walls_.centre(walls_.walls()[wall]));
  return mean_of(centres);
}

Rational3 Roadmap::interior_point(ZoneId zone) const {
  if (zone < tree_->leaves().size()) return interior_of_leaf(zone);
  for (const PortalId s : portals_of(zone)) {
    if (p_.portals[s].cell == cell_of(zone)) return point(s);
  }
  NEF_ASSERT(false);
  return {};
}

}  // namespace nef::planner
