// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/partition/zones.h"

#include <algorithm>

#include "apps/planner/partition/nudges.h"
#include "apps/planner/partition/segment_walk.h"
#include "apps/planner/partition/station_maker.h"
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

Zones::Zones(const Complex& complex, const CellNumbering& cells, SpaceTree& tree, const Monitor& monitor,
             const std::function<bool(CellId)>& selected)
    : complex_(&complex),
      cells_(&cells),
      tree_(&tree),
      walls_(complex, cells, tree, monitor, [&](CellId cell) { return cells.dimension(cell) == 2 && selected(cell); }) {
  s_ = StationMaker(complex, cells, tree, walls_, selected, monitor).make();
  make_lists(tree.leaves().size() + cells.facet(FacetId{0}), zone_begin_, zone_stations_, [&](const auto& visit) {
    for (StationId s = 0; s < s_.stations.size(); ++s) {
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

CellId Zones::cell_of(ZoneId zone) const {
  const auto leaves = static_cast<std::uint32_t>(tree_->leaves().size());
  return zone < leaves ? tree_->leaves()[zone].cell : zone - leaves;
}

Rational3 Zones::point(StationId id) const {
  const Station& station = s_.stations[id];
  switch (station.kind) {
    case Station::Kind::kWall:
      return walls_.centre(walls_.walls()[station.source]);
    case Station::Kind::kSeam:
      return walls_.centre(walls_.seams()[station.source]);
    case Station::Kind::kVertex:
      return complex_->points.rational(point_of(VertexId{station.source}));
    default: {
      const Rational3 a = complex_->points.rational(point_of(complex_->source(HalfedgeId{station.source})));
      const Rational3 b = complex_->points.rational(point_of(complex_->target(HalfedgeId{station.source})));
      return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    }
  }
}

ZoneId Zones::zone_at(const ExactPoint& point) const {
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

ZoneId Zones::zone_in(CellId cell) const {
  for (ZoneId zone = 0; zone < zone_count(); ++zone) {
    if (!stations_of(zone).empty() && cell_of(zone) == cell) return zone;
  }
  // No station: the cell is a single leaf by itself.
  for (LeafId leaf = 0; leaf < tree_->leaves().size(); ++leaf) {
    if (tree_->leaves()[leaf].cell == cell && tree_->leaves()[leaf].dimension == cells_->dimension(cell)) return leaf;
  }
  NEF_ASSERT(cells_->dimension(cell) <= 1);
  return static_cast<ZoneId>(tree_->leaves().size()) + cell;
}

Rational3 Zones::step_off(const Wall& wall, LeafId leaf) const {
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

Rational3 Zones::interior_of_room(LeafId leaf) const {
  const std::span<const std::uint32_t> around{leaf_walls_.data() + leaf_wall_begin_[leaf],
                                              leaf_wall_begin_[leaf + 1] - leaf_wall_begin_[leaf]};
  NEF_ASSERT(!around.empty());
  const bool room = tree_->leaves()[leaf].dimension == 3;
  const PlaneId first = walls_.walls()[around.front()].plane;
  const bool one_plane =
      std::all_of(around.begin(), around.end(), [&](std::uint32_t i) { return walls_.walls()[i].plane == first; });
  if (room && one_plane) return step_off(walls_.walls()[around.front()], leaf);
  // Points inside different faces of a convex body: their mean is inside the body.
  Rational3 sum;
  for (const std::uint32_t i : around) {
    const Rational3 x = walls_.centre(walls_.walls()[i]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += x[k];
  }
  for (Rational& value : sum) value /= Rational(static_cast<unsigned long>(around.size()));
  return sum;
}

Rational3 Zones::interior_point(ZoneId zone) const {
  if (zone < tree_->leaves().size()) return interior_of_room(zone);
  for (const StationId s : stations_of(zone)) {
    if (s_.stations[s].cell == cell_of(zone)) return point(s);
  }
  NEF_ASSERT(false);
  return {};
}

}  // namespace nef::planner
