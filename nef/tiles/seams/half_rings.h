// SPDX-License-Identifier: Apache-2.0
//
// What tiles look like on both sides of a wall at an ordinary vertex of the whole.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// Puts two sphere maps together that are the two halves of one ring of arcs, without an overlay. Keeps scratch: one
/// for each thread.
class HalfRings {
 public:
  /// The maps of tiles on both sides of one wall (its row), by common planes, at a point that is in no other wall of
  /// theirs; kOutside beyond the wall. If both are a path of arcs from the wall to the wall, with different marks to
  /// its left and right, fills the map of both together; else false. The paths fit together: what the tiles have in the
  /// wall is the same, and its circle has two points where the mark changes, one where a path with a given mark on its
  /// left goes up and one where such a path comes down. O(size of the maps), and the sign of a product where an edge
  /// lies in the wall.
  bool join(const PlaneTable& planes, std::uint32_t wall, const SphereMapView& one, const SphereMapView& other,
            SphereMapBuffer& out, const Monitor& monitor);

 private:
  // The arcs of a path, by shalfedges from its first svertex on, which is in the wall, as is the last one.
  struct Path {
    std::vector<std::uint32_t> arcs;
    LabelId left = 0;
    LabelId right = 0;
  };
  static bool read(const SphereMapView& map, std::uint32_t wall, Path& path);
  static void turn_around(Path& path);

  std::array<Path, 2> paths_;
};

}  // namespace nef
