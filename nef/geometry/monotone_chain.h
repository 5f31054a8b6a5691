// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of points in the plane, whatever stands for a point.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace nef {

/// Appends to `hull` the chain of the hull of `sorted` points that has them all on its left, from the first to the
/// last. left_turn(a, b, c) is true if the way from a by b to c turns left; points on sides are left out. Given right
/// turns, it is the chain that has them on its right. O(n).
template <class Point, class LeftTurn>
void append_hull_chain(std::span<const Point> sorted, const LeftTurn& left_turn, std::vector<Point>& hull) {
  const std::size_t begin = hull.size();
  for (const Point& point : sorted) {
    while (hull.size() >= begin + 2 && !left_turn(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
}

/// The corners of the convex hull of points in lexicographic order, counterclockwise from the first one, by two
/// monotone chains [Andrew 1979]; none of a single point. Points may repeat if left_turn is false for equal ones. O(n).
template <class Point, class LeftTurn>
std::vector<Point> convex_hull_of_sorted(std::vector<Point> sorted, const LeftTurn& left_turn) {
  std::vector<Point> hull;
  for (int chain = 0; chain < 2; ++chain) {  // the lower one, then the upper one back
    append_hull_chain(std::span<const Point>(sorted), left_turn, hull);
    if (!hull.empty()) hull.pop_back();  // the other chain begins with it
    std::reverse(sorted.begin(), sorted.end());
  }
  return hull;
}

}  // namespace nef
