// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/clearance.h"

#include <algorithm>
#include <cmath>

namespace nef::planner {
namespace {

double squared_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector ab = minus(b, a);
  const Vector ap = minus(p, a);
  const double length = dot(ab, ab);
  const double t = length > 0 ? std::clamp(dot(ap, ab) / length, 0.0, 1.0) : 0.0;
  const Vector off{ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]};
  return dot(off, off);
}

double squared_to_triangle(const Vector& p, const std::array<Vector, 3>& t) {
  const Vector u = minus(t[1], t[0]);
  const Vector v = minus(t[2], t[0]);
  const Vector n = cross(u, v);
  const double size = dot(n, n);
  const Vector w = minus(p, t[0]);
  if (size > 0) {
    const double a = dot(cross(w, v), n) / size;
    const double b = dot(cross(u, w), n) / size;
    if (a >= 0 && b >= 0 && a + b <= 1) {
      const double height = dot(w, n);
      return height * height / size;
    }
  }
  return std::min(
      {squared_to_segment(p, t[0], t[1]), squared_to_segment(p, t[1], t[2]), squared_to_segment(p, t[2], t[0])});
}

double squared_to_box(const Vector& p, const Box& box) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double off = std::max({box.low[i] - p[i], p[i] - box.high[i], 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

ClearanceField::ClearanceField(const FreeSpace& free) {
  const Complex& c = free.complex();
  const Walls& walls = free.zones().walls();
  for (const Wall& wall : walls.walls()) {
    const CellId cell = free.tree().leaves()[wall.on].cell;
    if (cell == kNoCell) continue;
    const Facet& facet = c.facets[free.cells().index(cell)];
    const bool boundary = !free.is_free(free.cells().volume(facet.volume_above)) ||
                          !free.is_free(free.cells().volume(facet.volume_below)) || !free.is_free(cell);
    if (!boundary) continue;
    const std::vector<Vector> corners = walls.approximate_corners(wall);
    for (std::size_t i = 2; i < corners.size(); ++i) triangles_.push_back({corners[0], corners[i - 1], corners[i]});
  }
  // Forbidden edges and points may lie in no facet.
  const CellNumbering& cells = free.cells();
  for (CellId cell = 0; cell < cells.facet(0); ++cell) {
    if (free.is_free(cell)) continue;
    const std::vector<Rational3> ends = free.vertices(cell);
    const Vector a = to_double(ends.front());
    triangles_.push_back({a, a, to_double(ends.back())});
  }
  std::vector<Box> boxes(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (const Vector& corner : triangles_[i]) boxes[i].add_rounded(corner);
  }
  boxes_ = BoxTree(boxes);
}

double ClearanceField::distance(const Vector& point) const {
  double best = HUGE_VAL;
  boxes_.for_each_if([&](const Box& box) { return squared_to_box(point, box) < best; },
                     [&](std::uint32_t i) { best = std::min(best, squared_to_triangle(point, triangles_[i])); });
  return std::sqrt(best);
}

}  // namespace nef::planner
