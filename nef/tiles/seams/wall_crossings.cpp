// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/seams/wall_crossings.h"

#include <algorithm>

#include "nef/geometry/search/box_tree.h"

namespace nef {
namespace {

// The edges below the cut and above it that the other side does not have.
std::array<std::vector<WallEdge>, 2> of_one_side(std::span<const WallEdge> edges) {
  struct Named {
    std::uint64_t points;
    std::uint32_t edge;
  };
  std::vector<Named> sorted;
  sorted.reserve(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    sorted.push_back({std::uint64_t{edges[i].points[0]} << 32U | edges[i].points[1], i});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Named& a, const Named& b) { return a.points < b.points; });
  std::array<std::vector<WallEdge>, 2> alone;
  for (std::size_t i = 0; i < sorted.size();) {
    const WallEdge& first = edges[sorted[i].edge];
    bool matched = false;
    std::size_t end = i;
    for (; end < sorted.size() && sorted[end].points == sorted[i].points; ++end) {
      matched = matched || edges[sorted[end].edge].above != first.above;
    }
    if (!matched) alone[first.above ? 1 : 0].push_back(first);
    i = end;
  }
  return alone;
}

Box box_of(const PointRef& from, const PointRef& to) {
  Box box;
  for (const PointRef& point : {from, to}) box.add_rounded(point.approximate());
  return box;
}

}  // namespace

std::vector<PlaneTriple> wall_crossings(const PlaneTable& planes, PlaneId cut, std::span<const WallEdge> edges,
                                        const Monitor& monitor, const std::function<PointRef(std::uint32_t)>& point,
                                        const std::function<PlaneId(const WallEdge&)>& other_plane) {
  std::vector<PlaneTriple> crossings;
  const auto [below, above] = of_one_side(edges);
  if (below.empty() || above.empty()) return crossings;
  const auto separates = [&](PlaneId plane, const WallEdge& edge) {
    return side_of_plane(planes, plane, point(edge.points[0]), monitor) *
               side_of_plane(planes, plane, point(edge.points[1]), monitor) <
           0;
  };
  const auto box = [&](const WallEdge& edge) { return box_of(point(edge.points[0]), point(edge.points[1])); };
  std::vector<Box> boxes;
  for (const WallEdge& edge : above) boxes.push_back(box(edge));
  std::vector<PlaneId> of_above(above.size());  // as they are asked for
  const BoxTree tree(boxes);
  for (const WallEdge& a : below) {
    PlaneId of_a;
    tree.for_each_overlap(box(a), [&, &others = above](std::uint32_t i) {
      if (!of_a.valid()) of_a = other_plane(a);
      if (!separates(of_a, others[i])) return;
      if (!of_above[i].valid()) of_above[i] = other_plane(others[i]);
      if (separates(of_above[i], a)) crossings.push_back({cut, of_a, of_above[i]});
    });
  }
  return crossings;
}

}  // namespace nef
