// SPDX-License-Identifier: Apache-2.0
//
// A point x projects to (u, v, h) = (x_i - x_k d_i / d_k, x_j - x_k d_j / d_k, x_k / d_k), where d_k is the largest
// coordinate of the direction d: a motion by t d adds t to h. Two solids without common inside points have disjoint
// intervals on each line of the direction, so one of them enters before the other on all of the region in which two
// projected faces overlap. Trees of boxes find pairs of faces whose boxes overlap in u and v, where the other solid's
// is not lower; three doubles with bounds tell most pairs of disjoint triangles; what is left is clipped exactly.
#include "apps/planner/assembly/entry_faces.h"

#include <algorithm>
#include <optional>

#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

// Twice the area of a triangle of the projection, positive if it is counterclockwise.
template <class Number>
Number turn(const std::array<Number, 3>& a, const std::array<Number, 3>& b, const std::array<Number, 3>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// What x_k takes with it: the projection of a point.
template <class Number>
std::array<Number, 3> project(const std::array<Number, 3>& x, const std::array<Number, 3>& d, std::size_t k) {
  const Number h = x[k] / d[k];
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  return {Number(x[i] - h * d[i]), Number(x[j] - h * d[j]), h};
}

Approximation3 approximated(const Rational3& x) {
  return {nef::approximation_of(x[0]), nef::approximation_of(x[1]), nef::approximation_of(x[2])};
}

}  // namespace

EntryFaces::EntryFaces(const Mesh& triangles, const Rational3& direction, const Monitor& monitor)
    : mesh_(triangles), direction_(direction) {
  for (std::size_t k = 1; k < 3; ++k) {
    if (abs(direction[k]) > abs(direction[axis_])) axis_ = k;
  }
  const Approximation3 rough = approximated(direction);
  for (const Rational3& vertex : mesh_.vertices) {
    points_.push_back(project(approximated(vertex), rough, axis_));
  }
  const int upward = sgn(direction[axis_]);
  for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
    const auto face = mesh_.face(f);
    Triangle corners{face[0], face[1], face[2]};
    const int orientation =
        sign_by_ladder(turn(points_[corners[0]], points_[corners[1]], points_[corners[2]]), monitor,
                       [&] { return sgn(turn(projected(corners[0]), projected(corners[1]), projected(corners[2]))); });
    if (orientation * upward >= 0) continue;  // left here, or passed along
    if (orientation < 0) std::swap(corners[1], corners[2]);
    Box& box = boxes_.emplace_back();
    for (const std::uint32_t v : corners) {
      std::array<double, 3> low{};
      std::array<double, 3> high{};
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = points_[v][i].value - points_[v][i].error;
        high[i] = points_[v][i].value + points_[v][i].error;
      }
      box.add_rounded(low);
      box.add_rounded(high);
    }
    triangles_.push_back(corners);
  }
  tree_ = BoxTree(boxes_);
}

EntryFaces::Point EntryFaces::projected(std::uint32_t vertex) const {
  return project(mesh_.vertices[vertex], direction_, axis_);
}

// Whether a side of one of the two triangles surely has the other one on its right.
bool EntryFaces::surely_beside(const Triangle& own, const EntryFaces& other, const Triangle& others) const {
  const auto parted = [](const std::vector<Approximation3>& p, const Triangle& a, const std::vector<Approximation3>& q,
                         const Triangle& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Approximation3& from = p[a[i]];
      const Approximation3& to = p[a[(i + 1) % 3]];
      if (std::all_of(b.begin(), b.end(), [&](std::uint32_t v) { return turn(from, to, q[v]).sign() == -1; }))
        return true;
    }
    return false;
  };
  return parted(points_, own, other.points_, others) || parted(other.points_, others, points_, own);
}

// The first triangle clipped by the sides of the other one. Heights above a point are linear, so the sum of their
// differences at all corners has the sign that they have inside.
bool EntryFaces::exactly_before(const Triangle& own, const EntryFaces& other, const Triangle& others) const {
  std::array<Point, 3> clip;
  std::vector<Point> polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    clip[i] = other.projected(others[i]);
    polygon.push_back(projected(own[i]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& from = clip[i];
    const Point& to = clip[(i + 1) % 3];
    std::vector<Point> left;
    bool any = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point& p = polygon[k];
      const Point& q = polygon[(k + 1) % polygon.size()];
      const Rational at_p = turn(from, to, p);
      const Rational at_q = turn(from, to, q);
      any = any || at_p > 0;
      if (at_p >= 0) left.push_back(p);
      if (sgn(at_p) * sgn(at_q) >= 0) continue;
      const Rational s = at_p / (at_p - at_q);
      Point crossing;
      for (std::size_t c = 0; c < 3; ++c) crossing[c] = p[c] + s * (q[c] - p[c]);
      left.push_back(crossing);
    }
    if (!any) return false;
    polygon = std::move(left);
  }
  // The height of the other face above a point, times a positive number, by its barycentric coordinates.
  const Rational area = turn(clip[0], clip[1], clip[2]);
  Rational sum = 0;
  for (const Point& p : polygon) {
    const Rational height = turn(clip[1], clip[2], p) * clip[0][2] + turn(clip[2], clip[0], p) * clip[1][2] +
                            turn(clip[0], clip[1], p) * clip[2][2];
    sum += height - area * p[2];
  }
  return sum > 0;
}

bool EntryFaces::is_before(const EntryFaces& other, const Monitor& monitor) const {
  bool found = false;
  for (std::size_t t = 0; t < triangles_.size() && !found; ++t) {
    monitor.check_interruption();
    const Box& own = boxes_[t];
    const auto above = [&](const Box& box) {
      return !found && own.low[0] <= box.high[0] && box.low[0] <= own.high[0] && own.low[1] <= box.high[1] &&
             box.low[1] <= own.high[1] && own.low[2] <= box.high[2];
    };
    other.tree_.for_each_if(above, [&](std::uint32_t s) {
      if (kFastPaths && surely_beside(triangles_[t], other, other.triangles_[s])) {
        monitor.count_filter();
      } else {
        monitor.count_exact();
        found = exactly_before(triangles_[t], other, other.triangles_[s]);
      }
    });
  }
  return found;
}

}  // namespace nef::planner
