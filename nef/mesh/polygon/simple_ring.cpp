// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/polygon/simple_ring.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace nef {

bool segments_meet(const MeshPoints& points, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                   std::size_t axis, const Monitor& monitor) {
  const int c_side = points.orientation_along(a, b, c, axis, monitor);
  const int d_side = points.orientation_along(a, b, d, axis, monitor);
  if (c_side * d_side > 0) return false;
  const int a_side = points.orientation_along(c, d, a, axis, monitor);
  const int b_side = points.orientation_along(c, d, b, axis, monitor);
  if (a_side * b_side > 0) return false;
  if (c_side != 0 || d_side != 0 || a_side != 0 || b_side != 0) return true;
  // All on one line: compare the intervals.
  const auto [low1, high1] = points.compare(a, b) < 0 ? std::pair{a, b} : std::pair{b, a};
  const auto [low2, high2] = points.compare(c, d) < 0 ? std::pair{c, d} : std::pair{d, c};
  return points.compare(low1, high2) <= 0 && points.compare(low2, high1) <= 0;
}

std::optional<std::array<std::uint32_t, 2>> sides_that_meet(const MeshPoints& points,
                                                            std::span<const std::uint32_t> ring, std::size_t axis,
                                                            const Monitor& monitor) {
  const auto n = static_cast<std::uint32_t>(ring.size());
  const auto corner = [&](std::uint32_t i) { return ring[i % n]; };
  std::vector<Box> boxes(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    points.extend(boxes[i], corner(i));
    points.extend(boxes[i], corner(i + 1));
  }
  // Neighbours meet in more than their corner if the second runs back along the first.
  const auto runs_back = [&](std::uint32_t i) {
    const std::uint32_t p = corner(i);
    const std::uint32_t q = corner(i + 1);
    const std::uint32_t r = corner(i + 2);
    return points.orientation_along(p, q, r, axis, monitor) == 0 &&
           (points.compare(p, q) < 0) == (points.compare(r, q) < 0);
  };
  std::optional<std::array<std::uint32_t, 2>> least;
  BoxTree(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const std::array<std::uint32_t, 2> pair{i, j};
    if (least && *least <= pair) return;
    bool meet = false;
    if (j == i + 1) {
      meet = runs_back(i);
    } else if ((j + 1) % n == i) {
      meet = runs_back(j);
    } else {
      meet = segments_meet(points, corner(i), corner(i + 1), corner(j), corner(j + 1), axis, monitor);
    }
    if (meet) least = pair;
  });
  return least;
}

}  // namespace nef
