// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/clearance.h"

#include <algorithm>
#include <cmath>

namespace nef::planner {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

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
  const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double size = dot(n, n);
  const Vector w = minus(p, t[0]);
  if (size > 0) {
    const Vector wv{w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2], w[0] * v[1] - w[1] * v[0]};
    const Vector uw{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
    const double a = dot(wv, n) / size;
    const double b = dot(uw, n) / size;
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
  std::vector<Box> boxes(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (const Vector& corner : triangles_[i]) boxes[i].add_rounded(corner);
  }
  boxes_ = BoxTree(boxes);
}

double ClearanceField::distance(const std::array<double, 3>& point) const {
  double best = HUGE_VAL;
  boxes_.for_each_if([&](const Box& box) { return squared_to_box(point, box) < best; },
                     [&](std::uint32_t i) { best = std::min(best, squared_to_triangle(point, triangles_[i])); });
  return std::sqrt(best);
}

}  // namespace nef::planner
