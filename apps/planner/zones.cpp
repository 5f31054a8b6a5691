// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/zones.h"

#include <algorithm>

#include "apps/planner/segment_walk.h"
#include "nef/base/error.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {
namespace {

Nudge cross(const Nudge& a, const Nudge& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

const std::array<Nudge, 3>& axes() {
  static const std::array<Nudge, 3> value{Nudge{1, 0, 0}, Nudge{0, 1, 0}, Nudge{0, 0, 1}};
  return value;
}

// Some vector across n.
Nudge across(const Nudge& n) {
  for (const Nudge& axis : axes()) {
    Nudge u = cross(n, axis);
    if (u[0] != 0 || u[1] != 0 || u[2] != 0) return u;
  }
  return n;
}

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

/// Makes the stations; nudges tell which leaf begins at a vertex or edge in which direction.
class StationMaker {
 public:
  StationMaker(Zones& zones, const std::function<bool(CellId)>& selected)
      : zones_(zones), complex_(*zones.complex_), cells_(*zones.cells_), tree_(*zones.tree_), selected_(selected) {}

  void make() {
    for (std::uint32_t i = 0; i < zones_.walls_.walls().size(); ++i) wall(i);
    for (std::uint32_t i = 0; i < zones_.walls_.seams().size(); ++i) seam(i);
    for (std::uint32_t v = 0; v < complex_.vertex_count(); ++v) {
      if (selected_(cells_.vertex(v))) vertex(v);
    }
    for (std::uint32_t h = 0; h < complex_.svertices.size(); ++h) {
      if (complex_.twin[h] > h && selected_(cells_.edge(h))) edge(h);
    }
  }

 private:
  using Kind = Zones::Station::Kind;

  void begin(Kind kind, std::uint32_t source, CellId cell, const std::array<double, 3>& approximate) {
    Zones::Station station;
    station.kind = kind;
    station.source = source;
    station.cell = cell;
    station.approximate = approximate;
    station.first_zone = static_cast<std::uint32_t>(zones_.station_zones_.size());
    zones_.stations_.push_back(station);
  }
  void add(ZoneId zone) { zones_.station_zones_.push_back(zone); }
  void add_leaf_if_selected(LeafId leaf) {
    const CellId cell = tree_.leaves()[leaf].cell;
    if (cell != kNoCell && selected_(cell)) add(leaf);
  }
  void end() {
    Zones::Station& station = zones_.stations_.back();
    const auto first = zones_.station_zones_.begin() + station.first_zone;
    std::sort(first, zones_.station_zones_.end());
    zones_.station_zones_.erase(std::unique(first, zones_.station_zones_.end()), zones_.station_zones_.end());
    station.zone_count = static_cast<std::uint32_t>(zones_.station_zones_.size()) - station.first_zone;
  }
  [[nodiscard]] ZoneId zone_of_cell(CellId cell) const { return static_cast<ZoneId>(tree_.leaves().size()) + cell; }

  void wall(std::uint32_t i) {
    const Wall& w = zones_.walls_.walls()[i];
    const CellId on = tree_.leaves()[w.on].cell;
    const CellId cell = on == kNoCell ? tree_.leaves()[w.below].cell : on;
    if (cell == kNoCell || !selected_(cell)) return;
    begin(Kind::kWall, i, cell, zones_.walls_.approximate_centre(w));
    if (on != kNoCell) add(w.on);
    add_leaf_if_selected(w.below);
    add_leaf_if_selected(w.above);
    end();
  }

  void seam(std::uint32_t i) {
    const Wall& s = zones_.walls_.seams()[i];
    begin(Kind::kSeam, i, tree_.leaves()[s.on].cell, zones_.walls_.approximate_centre(s));
    add_leaf_if_selected(s.below);
    add_leaf_if_selected(s.above);
    end();
  }

  [[nodiscard]] Nudge normal(PlaneId plane) const { return Direction::normal(complex_.planes, plane).integers(); }

  void facet_and_volume(const ExactPoint& point, const SHalfedge& e, std::uint32_t facet, std::uint32_t volume,
                        const Nudge& along, bool at_vertex) {
    const Nudge n = normal(e.plane);
    const Nudge inward = cross(n, along);
    const std::array<Nudge, 3> nudges =
        at_vertex ? std::array<Nudge, 3>{along, inward, n} : std::array<Nudge, 3>{inward, n, along};
    if (selected_(cells_.facet(facet))) {
      const std::array<Nudge, 2> in_facet{nudges[0], at_vertex ? nudges[1] : along};
      add(tree_.leaf_at(point, in_facet));
    }
    if (selected_(cells_.volume(volume))) add(tree_.leaf_at(point, nudges));
  }

  void vertex(std::uint32_t v) {
    const ExactPoint point(complex_.points.rational(PointId{v}));
    begin(Kind::kVertex, v, cells_.vertex(v), point.approximate());
    add(zone_of_cell(cells_.vertex(v)));
    const SphereMapView map = complex_.sphere_map(v);
    const VertexRecord& record = complex_.vertices[v];
    const auto volume_of = [&](std::uint32_t sface) { return complex_.sface_volume(record.sfaces + sface); };
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      const SVertex& svertex = map.svertices[s];
      const CellId edge = cells_.edge(record.svertices + s);
      if (selected_(edge)) add(zone_of_cell(edge));
      if (svertex.out == kNone && selected_(cells_.volume(volume_of(svertex.sface)))) {
        const std::array<Nudge, 4> nudges{direction_of(complex_.planes, svertex).integers(), axes()[0], axes()[1],
                                          axes()[2]};
        add(tree_.leaf_at(point, nudges));
      }
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      const SHalfedge& shalfedge = map.shalfedges[e];
      const Nudge along = direction_of(complex_.planes, map.svertices[shalfedge.source]).integers();
      facet_and_volume(point, shalfedge, complex_.shalfedge_facet[record.shalfedges + e] >> 1U,
                       volume_of(shalfedge.sface), along, true);
    }
    for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
      SHalfedge like;
      like.plane = map.sloops[l].plane;
      facet_and_volume(point, like, complex_.sloop_facet[record.sloops + l] >> 1U, volume_of(map.sloops[l].sface),
                       across(normal(like.plane)), true);
    }
    if (map.trivial() && selected_(cells_.volume(volume_of(0)))) add(tree_.leaf_at(point, axes()));
    end();
  }

  void edge(std::uint32_t h) {
    const std::uint32_t v = complex_.svertex_owner[h];
    const Rational3 a = complex_.points.rational(PointId{v});
    const Rational3 b = complex_.points.rational(PointId{complex_.target(h)});
    const ExactPoint point(Rational3{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    begin(Kind::kEdge, h, cells_.edge(h), point.approximate());
    add(zone_of_cell(cells_.edge(h)));
    const SphereMapView map = complex_.sphere_map(v);
    const VertexRecord& record = complex_.vertices[v];
    const SVertex& svertex = map.svertices[h - record.svertices];
    const auto volume_of = [&](std::uint32_t sface) { return complex_.sface_volume(record.sfaces + sface); };
    if (svertex.out == kNone) {
      if (selected_(cells_.volume(volume_of(svertex.sface)))) add(tree_.leaf_at(point, axes()));
    } else {
      const Nudge along = direction_of(complex_.planes, svertex).integers();
      std::uint32_t e = svertex.out;
      do {
        facet_and_volume(point, map.shalfedges[e], complex_.shalfedge_facet[record.shalfedges + e] >> 1U,
                         volume_of(map.shalfedges[e].sface), along, false);
        e = map.next_around(e);
      } while (e != svertex.out);
    }
    end();
  }

  Zones& zones_;
  const Complex& complex_;
  const CellNumbering& cells_;
  const SpaceTree& tree_;
  const std::function<bool(CellId)>& selected_;
};

Zones::Zones(const Complex& complex, const CellNumbering& cells, SpaceTree& tree,
             const std::function<bool(CellId)>& selected)
    : complex_(&complex),
      cells_(&cells),
      tree_(&tree),
      walls_(complex, cells, tree, [&](CellId cell) { return cells.dimension(cell) == 2 && selected(cell); }) {
  StationMaker(*this, selected).make();
  make_lists(tree.leaves().size() + cells.facet(0), zone_begin_, zone_stations_, [&](const auto& visit) {
    for (StationId s = 0; s < stations_.size(); ++s) {
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
  const Station& station = stations_[id];
  switch (station.kind) {
    case Station::Kind::kWall:
      return walls_.centre(walls_.walls()[station.source]);
    case Station::Kind::kSeam:
      return walls_.centre(walls_.seams()[station.source]);
    case Station::Kind::kVertex:
      return complex_->points.rational(PointId{station.source});
    default: {
      const Rational3 a = complex_->points.rational(PointId{complex_->svertex_owner[station.source]});
      const Rational3 b = complex_->points.rational(PointId{complex_->target(station.source)});
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
  const Nudge n = Direction::normal(complex_->planes, complex_->facets[cells_->index(cell)].plane).integers();
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
    if (stations_[s].cell == cell_of(zone)) return point(s);
  }
  NEF_ASSERT(false);
  return {};
}

}  // namespace nef::planner
