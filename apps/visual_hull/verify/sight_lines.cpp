// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/verify/sight_lines.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "apps/visual_hull/scene/pose.h"

namespace visual_hull {

SightView::SightView(const ComparedView& view) : matrix_(to_doubles(*view.camera)) {
  inverse_ = matrix_.leftCols<3>().inverse();
  for (int i = 0; i < 3; ++i) centre_[i] = nef::nearest_double(view.camera->centre()[static_cast<std::size_t>(i)]);
  for (const Ring& ring : view.silhouette->rings) {
    ring_begin_.push_back(static_cast<std::uint32_t>(u_.size()));
    for (const Point2& p : ring) {
      u_.push_back(p.approximate[0]);
      v_.push_back(p.approximate[1]);
    }
    u_.push_back(ring[0].approximate[0]);
    v_.push_back(ring[0].approximate[1]);
    area_ += twice_area(ring) / 2;
  }
  ring_begin_.push_back(static_cast<std::uint32_t>(u_.size()));
  for (std::size_t r = 0; r + 1 < ring_begin_.size(); ++r) {
    const std::uint32_t last = ring_begin_[r + 1] - 1;
    for (std::uint32_t begin = ring_begin_[r]; begin < last; begin += kRun)
      add_run(begin, std::min(begin + kRun, last));
  }
  angle_ = std::abs(inverse_.determinant()) * area_;
}

void SightView::add_run(std::uint32_t begin, std::uint32_t end) {
  const auto [left, right] = std::minmax_element(u_.begin() + begin, u_.begin() + end + 1);
  const auto [top, bottom] = std::minmax_element(v_.begin() + begin, v_.begin() + end + 1);
  runs_.push_back(
      {begin, end, (*left + *right) / 2, (*top + *bottom) / 2, std::hypot(*right - *left, *bottom - *top) / 2});
}

Eigen::Vector3d SightView::ray(const Eigen::Vector2d& image) const { return inverse_ * image.homogeneous(); }

bool SightView::inside(const Eigen::Vector2d& p) const {
  bool result = false;
  for (std::size_t r = 0; r + 1 < ring_begin_.size(); ++r) {
    for (std::size_t k = ring_begin_[r]; k + 1 < ring_begin_[r + 1]; ++k) {
      if ((v_[k] <= p[1]) == (v_[k + 1] <= p[1])) continue;
      if (u_[k] + (p[1] - v_[k]) / (v_[k + 1] - v_[k]) * (u_[k + 1] - u_[k]) > p[0]) result = !result;
    }
  }
  return result;
}

std::vector<Eigen::Vector2d> SightView::sample(std::size_t count) const {
  std::vector<Eigen::Vector2d> points;
  if (u_.empty() || !(area_ > 0)) return points;
  const auto [left, right] = std::minmax_element(u_.begin(), u_.end());
  const auto [top, bottom] = std::minmax_element(v_.begin(), v_.end());
  const Eigen::Vector2d low(*left, *top);
  const Eigen::Vector2d extent(*right - *left, *bottom - *top);
  // A low-discrepancy sequence in the plane: multiples of the powers of the plastic number's inverse (Roberts, 2018).
  constexpr double kPlastic = 1.32471795724474602596;
  const double share = area_ / (extent[0] * extent[1]);
  const auto tries = static_cast<std::size_t>(std::ceil(static_cast<double>(count) / share));
  for (std::size_t k = 1; k <= tries; ++k) {
    const double x = static_cast<double>(k) / kPlastic;
    const double y = static_cast<double>(k) / (kPlastic * kPlastic);
    const Eigen::Vector2d p = low + extent.cwiseProduct(Eigen::Vector2d(x - std::floor(x), y - std::floor(y)));
    if (inside(p)) points.push_back(p);
  }
  return points;
}

void SightView::cut(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, const DepthInterval& range,
                    std::vector<DepthInterval>& inside) const {
  // The line is seen at a + s b, homogeneous; only s with a positive depth are in front.
  const Eigen::Vector3d a = matrix_ * centre.homogeneous();
  const Eigen::Vector3d b = matrix_.leftCols<3>() * direction;
  double from = range.from;
  double to = range.to;
  const double least = 1e-9 * (std::abs(a[2]) + std::abs(b[2]) * std::max(std::abs(from), std::abs(to)));
  if (b[2] > 0) from = std::max(from, (least - a[2]) / b[2]);
  if (b[2] < 0) to = std::min(to, (least - a[2]) / b[2]);
  if (!(from < to) || !(a[2] + from * b[2] > 0) || !(a[2] + to * b[2] > 0)) return;
  const Eigen::Vector3d line = a.cross(b);
  Eigen::Vector2d along(line[1], -line[0]);
  const double length = along.norm();
  if (!(length > 1e-12 * a.norm() * b.norm())) {
    // Both cameras stand on the line, which is seen as a point.
    const Eigen::Vector3d x = a + (from + to) / 2 * b;
    if (this->inside(x.head<2>() / x[2])) inside.push_back({from, to});
    return;
  }
  along /= length;
  const double a_along = along.dot(a.head<2>());
  const double b_along = along.dot(b.head<2>());
  const auto place = [&](double s) { return (a_along + s * b_along) / (a[2] + s * b[2]); };
  const auto depth = [&](double t) { return (t * a[2] - a_along) / (b_along - t * b[2]); };

  thread_local std::vector<double> crossings;
  crossings.clear();
  const auto side = [&](std::size_t k) { return line[0] * u_[k] + line[1] * v_[k] + line[2]; };
  for (const Run& run : runs_) {
    // Twice the radius, far above roundings: a run that is left out is not crossed.
    if (std::abs(line[0] * run.u + line[1] * run.v + line[2]) > 2 * run.radius * length) continue;
    double before = side(run.begin);
    for (std::size_t k = run.begin; k < run.end; ++k) {
      const double here = before;
      before = side(k + 1);
      if ((here <= 0) == (before <= 0)) continue;
      const double share = here / (here - before);
      const Eigen::Vector2d p(u_[k] + share * (u_[k + 1] - u_[k]), v_[k] + share * (v_[k + 1] - v_[k]));
      crossings.push_back(along.dot(p));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  double first = place(from);
  double last = place(to);
  const bool backward = first > last;
  if (backward) std::swap(first, last);
  const std::size_t begun = inside.size();
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const double enter = std::max(crossings[k], first);
    const double leave = std::min(crossings[k + 1], last);
    if (!(enter < leave)) continue;
    const double s0 = std::clamp(depth(enter), from, to);
    const double s1 = std::clamp(depth(leave), from, to);
    inside.push_back({std::min(s0, s1), std::max(s0, s1)});
  }
  if (backward) std::reverse(inside.begin() + static_cast<std::ptrdiff_t>(begun), inside.end());
}

DepthInterval in_box(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, const Eigen::Vector3d& low,
                     const Eigen::Vector3d& high) {
  DepthInterval range{0, INFINITY};
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (centre[i] < low[i] || centre[i] > high[i]) return {1, 0};
      continue;
    }
    const double x = (low[i] - centre[i]) / direction[i];
    const double y = (high[i] - centre[i]) / direction[i];
    range.from = std::max(range.from, std::min(x, y));
    range.to = std::min(range.to, std::max(x, y));
  }
  return range;
}

}  // namespace visual_hull
