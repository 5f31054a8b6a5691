// SPDX-License-Identifier: Apache-2.0
//
// Free space as convex zones and the stations where one may change from zone to zone. It is the
// roadmap of the planner, and it is complete: two points are in one component of free space iff
// their zones are connected by stations.
//
// A zone is a relatively open convex set inside one selected cell: a leaf of the space partition
// (in a volume or facet), an edge or a vertex. A station is a point in the closure of each of its
// zones. Proof of completeness: inside one volume (facet), neighbouring leaves share walls (seams),
// and an open connected set stays connected without what has codimension two; each wall is a
// station. Two cells of which one lies in the closure of the other share a station at the smaller
// one: a vertex, the middle of an edge, a wall in a facet; incidence does not change along a cell.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "apps/planner/partition/walls.h"
#include "nef/base/monitor.h"

namespace nef::planner {

using ZoneId = std::uint32_t;
using StationId = std::uint32_t;

class Zones {
 public:
  /// A place where zones meet.
  struct Station {
    CellId cell = kNoCell;  ///< what holds the point (the volume for a wall inside one)
    std::array<double, 3> approximate{};
    std::uint32_t first_zone = 0;
    std::uint32_t zone_count = 0;
    enum class Kind : std::uint8_t { kWall, kSeam, kVertex, kEdge } kind = Kind::kWall;
    std::uint32_t source = 0;  ///< index of the wall or seam, vertex, or halfedge
  };

  /// All stations with their zones, station after station.
  struct Stations {
    std::vector<Station> stations;
    std::vector<ZoneId> zones;
  };

  /// `selected` tells which cells are free. The tree and the complex must outlive the result.
  Zones(const Complex& complex, const CellNumbering& cells, SpaceTree& tree, const Monitor& monitor,
        const std::function<bool(CellId)>& selected);

  [[nodiscard]] const Walls& walls() const { return walls_; }
  [[nodiscard]] std::span<const Station> stations() const { return s_.stations; }
  [[nodiscard]] std::span<const ZoneId> zones_of(StationId station) const {
    return {s_.zones.data() + s_.stations[station].first_zone, s_.stations[station].zone_count};
  }
  [[nodiscard]] std::span<const StationId> stations_of(ZoneId zone) const {
    return {zone_stations_.data() + zone_begin_[zone], zone_begin_[zone + 1] - zone_begin_[zone]};
  }
  [[nodiscard]] std::size_t zone_count() const { return zone_begin_.size() - 1; }
  [[nodiscard]] CellId cell_of(ZoneId zone) const;

  /// The exact place of a station.
  [[nodiscard]] Rational3 point(StationId station) const;
  /// The zone of a free point: it lies in the zone, or in its closure and in the same volume.
  [[nodiscard]] ZoneId zone_at(const ExactPoint& point) const;
  /// Some zone in a free cell. O(zones).
  [[nodiscard]] ZoneId zone_in(CellId cell) const;
  /// A point inside the zone.
  [[nodiscard]] Rational3 interior_point(ZoneId zone) const;

 private:
  [[nodiscard]] Rational3 interior_of_room(LeafId leaf) const;
  [[nodiscard]] Rational3 step_off(const Wall& wall, LeafId leaf) const;

  const Complex* complex_;
  const CellNumbering* cells_;
  const SpaceTree* tree_;
  Walls walls_;
  Stations s_;
  std::vector<std::uint32_t> zone_begin_;
  std::vector<StationId> zone_stations_;
  std::vector<std::uint32_t> leaf_wall_begin_;  // walls around (3-dimensional) or in (2-dimensional) each leaf
  std::vector<std::uint32_t> leaf_walls_;
};

}  // namespace nef::planner
