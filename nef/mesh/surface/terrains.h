// SPDX-License-Identifier: Apache-2.0
//
// Parts of a triangulated surface that lie over a plane as a landscape does.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/polygon/plain_border.h"
#include "nef/mesh/surface/vertex_stars.h"

namespace nef {

/// Finds *terrains*: sets of triangles that one axis sees from one side and that surely have nothing in common beyond
/// shared vertices and edges [Volino, Magnenat-Thalmann 1994]. All turn the same way in the projection along the axis,
/// so they cover a point as often as the sides at their border wind around it; and these are found to do so once at
/// most and to meet at common ends only (PlainBorder). Then the images of triangles are disjoint but for their borders.
/// Around a point of an edge that two of them share, or of a vertex with such edges only, there are triangles on all
/// sides, so no other one comes there; and what else two triangles may have in common are points of the border.
class Terrains {
 public:
  /// Triangles of points and their stars. All must outlive this object.
  Terrains(const MeshPoints& points, const VertexStars& stars, std::span<const VertexStars::Triangle> triangles,
           const Monitor& monitor);

  /// True if these triangles are found to be a terrain. Those with more sides at their border than there are triangles
  /// are not tested. O(n + k log k) for k sides at the border of n triangles unless a line crosses very many of them;
  /// much less as a rule where no axis sees all of them from one side.
  bool is_terrain(std::span<const std::uint32_t> triangles);

 private:
  void collect_border(std::span<const std::uint32_t> triangles);

  const VertexStars& stars_;
  std::span<const VertexStars::Triangle> triangles_;
  Monitor monitor_;
  PlainBorder test_;
  std::vector<PlainBorder::Side> border_;
  std::vector<std::uint32_t> round_of_;  // of each triangle, the last one that it was asked about in
  std::uint32_t round_ = 0;
};

}  // namespace nef
