// SPDX-License-Identifier: Apache-2.0
//
// Where leaves of a space partition meet: the polygons between 3-dimensional leaves and the
// segments between 2-dimensional ones.
#pragma once

#include <vector>

#include "apps/planner/partition/space_tree.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A relatively open convex polygon (segment) between two leaves of dimension 3 (2).
struct Wall {
  PlaneId plane;        ///< its plane; `below` and `above` are meant by it
  LeafId on = kNoLeaf;  ///< the leaf that it is part of
  LeafId below = kNoLeaf;
  LeafId above = kNoLeaf;
  std::uint32_t first_point = 0;
  std::uint32_t point_count = 0;
};

/// Walls between leaves of dimension 3, seams between leaves of dimension 2, and the points of both.
struct WallLists {
  std::vector<Wall> walls;
  std::vector<Wall> seams;
  std::vector<PointId> corners;
  PointTable points;
};

/// All walls of a tree.
class Walls {
 public:
  explicit Walls(WallLists lists) : w_(std::move(lists)) {}
  /// `wanted_facet` tells for which facets' cells the segments between their leaves are wanted.
  /// Finds out the volume of every 3-dimensional leaf and stores it in the tree: a wall in a facet
  /// knows the volumes beside it, and a wall in no facet has the same volume on both sides.
  Walls(const Complex& complex, const CellNumbering& cells, SpaceTree& tree, const Monitor& monitor,
        const std::function<bool(CellId)>& wanted_facet);

  [[nodiscard]] const std::vector<Wall>& walls() const { return w_.walls; }
  [[nodiscard]] const std::vector<Wall>& seams() const { return w_.seams; }
  /// The mean of the corners of a wall or seam.
  [[nodiscard]] Rational3 centre(const Wall& wall) const;
  [[nodiscard]] std::array<double, 3> approximate_centre(const Wall& wall) const;
  /// The corners in order.
  [[nodiscard]] std::vector<std::array<double, 3>> approximate_corners(const Wall& wall) const;

 private:
  WallLists w_;
};

}  // namespace nef::planner
