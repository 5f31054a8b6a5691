// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/seams/wall_crossings.h"

#include <algorithm>

#include "nef/geometry/box_tree.h"
#include "nef/geometry/predicates.h"

namespace nef {
namespace {

// The edges below the cut and above it that the other side does not have.
std::array<std::vector<WallEdge>, 2> of_one_side(std::vector<WallEdge>&& edges) {
  std::sort(edges.begin(), edges.end(), [](const WallEdge& a, const WallEdge& b) { return a.key() < b.key(); });
  std::array<std::vector<WallEdge>, 2> alone;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    bool matched = false;
    while (end < edges.size() && edges[end].points == edges[i].points) {
      matched = matched || edges[end].above != edges[i].above;
      ++end;
    }
    if (!matched) alone[edges[i].above ? 1 : 0].push_back(edges[i]);
    i = end;
  }
  return alone;
}

Box box_of(const WallEdge& edge, const PointTable& points) {
  Box box;
  for (const std::uint32_t point : edge.points) box.add_rounded(points.approximate(PointId{point}));
  return box;
}

}  // namespace

std::vector<PlaneTriple> wall_crossings(const PlaneTable& planes, PlaneId cut, const PointTable& points,
                                        std::vector<WallEdge>&& edges,
                                        const std::function<PlaneId(const WallEdge&)>& other_plane) {
  std::vector<PlaneTriple> crossings;
  const auto [below, above] = of_one_side(std::move(edges));
  if (below.empty() || above.empty()) return crossings;
  const auto separates = [&](PlaneId plane, const WallEdge& edge) {
    return side_of_plane(planes, plane, points, PointId{edge.points[0]}) *
               side_of_plane(planes, plane, points, PointId{edge.points[1]}) <
           0;
  };
  std::vector<Box> boxes;
  for (const WallEdge& edge : above) boxes.push_back(box_of(edge, points));
  const BoxTree tree(boxes);
  for (const WallEdge& a : below) {
    tree.for_each_overlap(box_of(a, points), [&, &others = above](std::uint32_t i) {
      const WallEdge& b = others[i];
      const PlaneId of_a = other_plane(a);
      if (!separates(of_a, b)) return;
      const PlaneId of_b = other_plane(b);
      if (separates(of_b, a)) crossings.push_back({cut, of_a, of_b});
    });
  }
  return crossings;
}

}  // namespace nef
