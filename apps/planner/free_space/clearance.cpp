// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/clearance.h"

#include <algorithm>
#include <cmath>

namespace nef::planner {
namespace {

double squared_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).squaredNorm();
}

double squared_to_triangle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d u = t[1] - t[0];
  const Vector3d v = t[2] - t[0];
  const Vector3d w = p - t[0];
  const Vector3d n = u.cross(v);
  const double size = n.squaredNorm();
  if (size > 0) {
    const double a = w.cross(v).dot(n) / size;
    const double b = u.cross(w).dot(n) / size;
    const double height = w.dot(n);
    if (a >= 0 && b >= 0 && a + b <= 1) return height * height / size;
  }
  return std::min(
      {squared_to_segment(p, t[0], t[1]), squared_to_segment(p, t[1], t[2]), squared_to_segment(p, t[2], t[0])});
}

double squared_to_box(const Vector3d& p, const Box& box) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = p[static_cast<Eigen::Index>(i)];
    const double off = std::max({box.low[i] - x, x - box.high[i], 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

ClearanceField::ClearanceField(const FreeSpace& free) {
  const Complex& c = free.complex();
  const Walls& walls = free.roadmap().walls();
  for (const Wall& wall : walls.walls()) {
    const CellId cell = free.tree().leaves()[wall.on].cell;
    if (cell == kNoCell) continue;
    const Facet& facet = c.facets[FacetId{free.cells().index(cell)}];
    const bool boundary = !free.is_free(free.cells().volume(facet.volume_above)) ||
                          !free.is_free(free.cells().volume(facet.volume_below)) || !free.is_free(cell);
    if (!boundary) continue;
    std::vector<Vector3d> corners;
    for (const std::array<double, 3>& corner : walls.approximate_corners(wall)) corners.push_back(to_vector(corner));
    for (std::size_t i = 2; i < corners.size(); ++i) triangles_.push_back({corners[0], corners[i - 1], corners[i]});
  }
  // Forbidden edges and points may lie in no facet.
  const CellNumbering& cells = free.cells();
  for (CellId cell = 0; cell < cells.facet(FacetId{0}); ++cell) {
    if (free.is_free(cell)) continue;
    const std::vector<Rational3> ends = free.vertices(cell);
    const Vector3d a = to_vector(ends.front());
    triangles_.push_back({a, a, to_vector(ends.back())});
  }
  std::vector<Box> boxes(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (const Vector3d& corner : triangles_[i]) boxes[i].add_rounded(to_array(corner));
  }
  boxes_ = BoxTree(boxes);
}

double ClearanceField::distance(const Vector3d& point) const {
  double best = HUGE_VAL;
  boxes_.for_each_if([&](const Box& box) { return squared_to_box(point, box) < best; },
                     [&](std::uint32_t i) { best = std::min(best, squared_to_triangle(point, triangles_[i])); });
  return std::sqrt(best);
}

}  // namespace nef::planner
