// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/partition/portal_maker.h"

#include <algorithm>

#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {

Roadmap::Portals PortalMaker::make() {
  for (std::uint32_t i = 0; i < walls_.walls().size(); ++i) wall(i);
  for (std::uint32_t i = 0; i < walls_.seams().size(); ++i) seam(i);
  for (const VertexId v : complex_.vertex_ids()) {
    if (selected_(cells_.vertex(v))) vertex(v);
  }
  for (const HalfedgeId h : complex_.halfedge_ids()) {
    if (complex_.twin[h] > h && selected_(cells_.edge(h))) edge(h);
  }
  return std::move(out_);
}

void PortalMaker::begin(Kind kind, std::uint32_t source, CellId cell, const std::array<double, 3>& approximate) {
  monitor_.check_interruption();
  Roadmap::Portal portal;
  portal.kind = kind;
  portal.source = source;
  portal.cell = cell;
  portal.approximate = approximate;
  portal.first_zone = static_cast<std::uint32_t>(out_.zones.size());
  out_.portals.push_back(portal);
}

void PortalMaker::add_leaf_if_selected(LeafId leaf) {
  const CellId cell = tree_.leaves()[leaf].cell;
  if (cell != kNoCell && selected_(cell)) add(leaf);
}

void PortalMaker::end() {
  Roadmap::Portal& portal = out_.portals.back();
  const auto first = out_.zones.begin() + portal.first_zone;
  std::sort(first, out_.zones.end());
  out_.zones.erase(std::unique(first, out_.zones.end()), out_.zones.end());
  portal.zone_count = static_cast<std::uint32_t>(out_.zones.size()) - portal.first_zone;
}

void PortalMaker::wall(std::uint32_t i) {
  const Wall& w = walls_.walls()[i];
  const CellId on = tree_.leaves()[w.on].cell;
  const CellId cell = on == kNoCell ? tree_.leaves()[w.below].cell : on;
  if (cell == kNoCell || !selected_(cell)) return;
  begin(Kind::kWall, i, cell, walls_.approximate_centre(w));
  if (on != kNoCell) add(w.on);
  add_leaf_if_selected(w.below);
  add_leaf_if_selected(w.above);
  end();
}

void PortalMaker::seam(std::uint32_t i) {
  const Wall& s = walls_.seams()[i];
  begin(Kind::kSeam, i, tree_.leaves()[s.on].cell, walls_.approximate_centre(s));
  add_leaf_if_selected(s.below);
  add_leaf_if_selected(s.above);
  end();
}

Nudge PortalMaker::normal(PlaneId plane) const { return Direction::normal(complex_.planes, plane).integers(); }

void PortalMaker::facet_and_volume(const ExactPoint& point, const SHalfedge& e, FacetId facet, VolumeId volume,
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

void PortalMaker::vertex(VertexId v) {
  const ExactPoint point(complex_.points.rational(point_of(v)));
  begin(Kind::kVertex, v.index(), cells_.vertex(v), point.approximate());
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
    facet_and_volume(point, shalfedge, facet_of(complex_.shalfedge_facet[record.shalfedges + e]),
                     volume_of(shalfedge.sface), along, true);
  }
  for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
    SHalfedge like;
    like.plane = map.sloops[l].plane;
    facet_and_volume(point, like, facet_of(complex_.sloop_facet[record.sloops + l]), volume_of(map.sloops[l].sface),
                     across(normal(like.plane)), true);
  }
  if (map.trivial() && selected_(cells_.volume(volume_of(0)))) add(tree_.leaf_at(point, axes()));
  end();
}

void PortalMaker::edge(HalfedgeId h) {
  const VertexId v = complex_.source(h);
  const Rational3 a = complex_.points.rational(point_of(v));
  const Rational3 b = complex_.points.rational(point_of(complex_.target(h)));
  const ExactPoint point(point_between(a, b, Rational(1, 2)));
  begin(Kind::kEdge, h.index(), cells_.edge(h), point.approximate());
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
      facet_and_volume(point, map.shalfedges[e], facet_of(complex_.shalfedge_facet[record.shalfedges + e]),
                       volume_of(map.shalfedges[e].sface), along, false);
      e = map.next_around(e);
    } while (e != svertex.out);
  }
  end();
}

}  // namespace nef::planner
