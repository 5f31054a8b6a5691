// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/verify/sight_lines.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "apps/visual_hull/scene/pose.h"

namespace visual_hull {
namespace {

constexpr std::size_t kBins = 1024;             // of half a turn
constexpr double kBinsOfQuarter = kBins / 2.0;  // which turn_of has as 1
constexpr double kTurnSlack = 1e-9;             // far above roundings

// Grows with the angle of (x, y): 1 for a quarter turn, from 0 to 4.
double turn_of(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (!(size > 0)) return 0;
  const double t = y / size;
  if (x < 0) return 2 - t;
  return y < 0 ? 4 + t : t;
}

}  // namespace

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
  angle_ = std::abs(inverse_.determinant()) * area_;
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

// A vertex w of the outline lies on the side (a x M d) . w = d . M^T (w x a) of the line in which the direction d is
// seen, a the image of the point. M^T (w x a) is at right angles to the line through point and camera, so two numbers
// tell its sign for every d, and a side is crossed where they differ at its ends: by the directions between those that
// see one end and the other.
SightPencil::SightPencil(const SightView& view, const Eigen::Vector3d& centre)
    : view_(view), epipole_(view.matrix_ * centre.homogeneous()) {
  const Eigen::Matrix3d block = view.matrix_.leftCols<3>();
  Eigen::Vector3d axis = centre - view.centre_;
  if (axis.squaredNorm() == 0) axis = Eigen::Vector3d::UnitX();  // every line is seen as a point
  across_.col(0) = axis.unitOrthogonal();
  across_.col(1) = axis.normalized().cross(across_.col(0));
  const Eigen::Vector3d form0 = epipole_.cross(block * across_.col(0));
  const Eigen::Vector3d form1 = epipole_.cross(block * across_.col(1));
  std::vector<double> turns(view.u_.size());
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const double x = form0[0] * view.u_[k] + form0[1] * view.v_[k] + form0[2];
    const double y = form1[0] * view.u_[k] + form1[1] * view.v_[k] + form1[2];
    turns[k] = turn_of(-y, x);
  }
  // Twice over the sides: count, then fill.
  bin_begin_.assign(kBins + 1, 0);
  for (const bool fill : {false, true}) {
    for (std::size_t r = 0; r + 1 < view.ring_begin_.size(); ++r) {
      for (std::uint32_t k = view.ring_begin_[r]; k + 1 < view.ring_begin_[r + 1]; ++k) {
        const double step = std::remainder(turns[k + 1] - turns[k], 4.0);
        const double low = (step < 0 ? turns[k + 1] : turns[k]) - kTurnSlack;
        const double high = low + std::abs(step) + 2 * kTurnSlack;
        const auto last = static_cast<std::int64_t>(std::floor(high * kBinsOfQuarter));
        for (auto bin = static_cast<std::int64_t>(std::floor(low * kBinsOfQuarter)); bin <= last; ++bin) {
          const std::size_t at = static_cast<std::size_t>(bin + kBins) % kBins;
          if (fill) {
            bin_sides_[--bin_begin_[at + 1]] = k;
          } else {
            ++bin_begin_[at + 1];
          }
        }
      }
    }
    if (fill) break;
    for (std::size_t bin = 0; bin < kBins; ++bin) bin_begin_[bin + 1] += bin_begin_[bin];
    bin_sides_.resize(bin_begin_[kBins]);
  }
  // Filling has moved each end to the beginning: bin b now begins at bin_begin_[b + 1].
  std::move(bin_begin_.begin() + 1, bin_begin_.end(), bin_begin_.begin());
  bin_begin_[kBins] = static_cast<std::uint32_t>(bin_sides_.size());
}

void SightPencil::find_crossings(const Eigen::Vector3d& direction, const Eigen::Vector3d& line,
                                 const Eigen::Vector2d& along, std::vector<double>& crossings) const {
  const double turn = turn_of(direction.dot(across_.col(0)), direction.dot(across_.col(1)));
  const std::size_t bin = static_cast<std::size_t>(turn * kBinsOfQuarter) % kBins;
  const std::vector<double>& u = view_.u_;
  const std::vector<double>& v = view_.v_;
  const auto side = [&](std::size_t k) { return line[0] * u[k] + line[1] * v[k] + line[2]; };
  for (std::uint32_t i = bin_begin_[bin]; i < bin_begin_[bin + 1]; ++i) {
    const std::uint32_t k = bin_sides_[i];
    const double here = side(k);
    const double there = side(k + 1);
    if ((here <= 0) == (there <= 0)) continue;
    const double share = here / (here - there);
    const Eigen::Vector2d p(u[k] + share * (u[k + 1] - u[k]), v[k] + share * (v[k + 1] - v[k]));
    crossings.push_back(along.dot(p));
  }
  std::sort(crossings.begin(), crossings.end());
}

void SightPencil::cut(const Eigen::Vector3d& direction, const DepthInterval& range,
                      std::vector<DepthInterval>& inside) const {
  // The line is seen at a + s b, homogeneous; only s with a positive depth are in front.
  const Eigen::Vector3d& a = epipole_;
  const Eigen::Vector3d b = view_.matrix_.leftCols<3>() * direction;
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
    if (view_.inside(x.head<2>() / x[2])) inside.push_back({from, to});
    return;
  }
  along /= length;
  const double a_along = along.dot(a.head<2>());
  const double b_along = along.dot(b.head<2>());
  const auto place = [&](double s) { return (a_along + s * b_along) / (a[2] + s * b[2]); };
  const auto depth = [&](double t) { return (t * a[2] - a_along) / (b_along - t * b[2]); };

  thread_local std::vector<double> crossings;
  crossings.clear();
  find_crossings(direction, line, along, crossings);
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
