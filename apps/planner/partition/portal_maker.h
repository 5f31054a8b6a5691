// SPDX-License-Identifier: Apache-2.0
//
// Finds the places where zones meet.
#pragma once

#include "apps/planner/partition/roadmap.h"
#include "apps/planner/partition/space_tree.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Makes the portals of a partition whose walls are known already: one per wall, seam, vertex and edge that is
/// selected. Nudges tell which leaf begins at a vertex or edge in which direction.
class PortalMaker {
 public:
  /// All arguments but the monitor must outlive the object.
  PortalMaker(const Complex& complex, const CellNumbering& cells, const SpaceTree& tree, const Walls& walls,
              const std::function<bool(CellId)>& selected, const Monitor& monitor)
      : complex_(complex), cells_(cells), tree_(tree), walls_(walls), selected_(selected), monitor_(monitor) {}

  /// O(items of the complex and walls) locations in the tree.
  Roadmap::Portals make();

 private:
  using Kind = Roadmap::Portal::Kind;

  // A portal is begun, gets its zones, and ends.
  void begin(Kind kind, std::uint32_t source, CellId cell, const std::array<double, 3>& approximate);
  void add(ZoneId zone) { out_.zones.push_back(zone); }
  void add_leaf_if_selected(LeafId leaf);
  void end();

  void wall(std::uint32_t i);
  void seam(std::uint32_t i);
  void vertex(VertexId v);
  void edge(HalfedgeId h);
  // The zones of the facet and of the volume that begin at a point of their boundary, to the left of direction `along`.
  void facet_and_volume(const ExactPoint& point, const SHalfedge& e, FacetId facet, VolumeId volume, const Nudge& along,
                        bool at_vertex);
  [[nodiscard]] ZoneId zone_of_cell(CellId cell) const { return static_cast<ZoneId>(tree_.leaves().size()) + cell; }
  [[nodiscard]] Nudge normal(PlaneId plane) const;

  const Complex& complex_;
  const CellNumbering& cells_;
  const SpaceTree& tree_;
  const Walls& walls_;
  const std::function<bool(CellId)>& selected_;
  Monitor monitor_;
  Roadmap::Portals out_;
};

}  // namespace nef::planner
