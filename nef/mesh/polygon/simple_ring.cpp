// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/polygon/simple_ring.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace nef {
namespace {

// True if the closed segments ab and cd have a point in common.
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

}  // namespace

std::optional<std::array<std::uint32_t, 2>> sides_that_meet(const MeshPoints& points,
                                                            std::span<const std::uint32_t> corners,
                                                            std::span<const std::uint32_t> ring_end, std::size_t axis,
                                                            const Monitor& monitor) {
  const auto n = static_cast<std::uint32_t>(corners.size());
  std::vector<std::uint32_t> next(n);
  for (std::uint32_t begin = 0; const std::uint32_t end : ring_end) {
    for (std::uint32_t i = begin; i < end; ++i) next[i] = i + 1 == end ? begin : i + 1;
    begin = end;
  }
  std::vector<Box> boxes(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    points.extend(boxes[i], corners[i]);
    points.extend(boxes[i], corners[next[i]]);
  }
  // Neighbours meet in more than their corner if the second runs back along the first.
  const auto runs_back = [&](std::uint32_t i) {
    const std::uint32_t p = corners[i];
    const std::uint32_t q = corners[next[i]];
    const std::uint32_t r = corners[next[next[i]]];
    return points.orientation_along(p, q, r, axis, monitor) == 0 &&
           (points.compare(p, q) < 0) == (points.compare(r, q) < 0);
  };
  std::optional<std::array<std::uint32_t, 2>> least;
  BoxTree(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const std::array<std::uint32_t, 2> pair{i, j};
    if (least && *least <= pair) return;
    bool meet = false;
    if (next[i] == j || next[j] == i) {
      meet = runs_back(next[i] == j ? i : j);
    } else {
      meet = segments_meet(points, corners[i], corners[next[i]], corners[j], corners[next[j]], axis, monitor);
    }
    if (meet) least = pair;
  });
  return least;
}

}  // namespace nef
