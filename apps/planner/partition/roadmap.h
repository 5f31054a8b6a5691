// SPDX-License-Identifier: Apache-2.0
//
// Free space as convex zones and the portals where one may change from zone to zone. It is the
// roadmap of the planner, and it is complete: two points are in one component of free space iff
// their zones are connected by portals.
//
// A zone is a relatively open convex set inside one selected cell: a leaf of the space partition
// (in a volume or facet), an edge or a vertex. A portal is a point in the closure of each of its
// zones. Proof of completeness: inside one volume (facet), neighbouring leaves share walls (seams),
// and an open connected set stays connected without what has codimension two; each wall is a
// portal. Two cells of which one lies in the closure of the other share a portal at the smaller
// one: a vertex, the middle of an edge, a wall in a facet; incidence does not change along a cell.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "apps/planner/partition/walls.h"
#include "nef/base/monitor.h"

namespace nef::planner {

using ZoneId = std::uint32_t;
using PortalId = std::uint32_t;

class Roadmap {
 public:
  /// A place where zones meet.
  struct Portal {
    CellId cell = kNoCell;  ///< what holds the point (the volume for a wall inside one)
    std::array<double, 3> approximate{};
    std::uint32_t first_zone = 0;
    std::uint32_t zone_count = 0;
    enum class Kind : std::uint8_t { kWall, kSeam, kVertex, kEdge } kind = Kind::kWall;
    std::uint32_t source = 0;  ///< index of the wall or seam, vertex, or halfedge
  };

  /// All portals with their zones, portal after portal.
  struct Portals {
    std::vector<Portal> portals;
    std::vector<ZoneId> zones;
  };

  /// `selected` tells which cells are free. The tree and the complex must outlive the result.
  Roadmap(const Complex& complex, const CellNumbering& cells, SpaceTree& tree, const Monitor& monitor,
          const std::function<bool(CellId)>& selected);

  [[nodiscard]] const Walls& walls() const { return walls_; }
  [[nodiscard]] std::span<const Portal> portals() const { return p_.portals; }
  [[nodiscard]] std::span<const ZoneId> zones_of(PortalId portal) const {
    return {p_.zones.data() + p_.portals[portal].first_zone, p_.portals[portal].zone_count};
  }
  [[nodiscard]] std::span<const PortalId> portals_of(ZoneId zone) const {
    return {zone_portals_.data() + zone_begin_[zone], zone_begin_[zone + 1] - zone_begin_[zone]};
  }
  [[nodiscard]] std::size_t zone_count() const { return zone_begin_.size() - 1; }
  [[nodiscard]] CellId cell_of(ZoneId zone) const;

  /// The exact place of a portal.
  [[nodiscard]] Rational3 point(PortalId portal) const;
  /// The zone of a free point: it lies in the zone, or in its closure and in the same volume.
  [[nodiscard]] ZoneId zone_at(const ExactPoint& point) const;
  /// Some zone in a free cell. O(zones).
  [[nodiscard]] ZoneId zone_in(CellId cell) const;
  /// A point inside the zone.
  [[nodiscard]] Rational3 interior_point(ZoneId zone) const;

 private:
  [[nodiscard]] Rational3 interior_of_leaf(LeafId leaf) const;
  [[nodiscard]] Rational3 step_off(const Wall& wall, LeafId leaf) const;

  const Complex* complex_;
  const CellNumbering* cells_;
  const SpaceTree* tree_;
  Walls walls_;
  Portals p_;
  std::vector<std::uint32_t> zone_begin_;
  std::vector<PortalId> zone_portals_;
  std::vector<std::uint32_t> leaf_wall_begin_;  // walls around (3-dimensional) or in (2-dimensional) each leaf
  std::vector<std::uint32_t> leaf_walls_;
};

}  // namespace nef::planner
