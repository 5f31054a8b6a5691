// SPDX-License-Identifier: Apache-2.0
//
// All lines through the centre of one camera are seen by another camera as lines through one point of its image, the
// epipole. So the sides of an outline are sorted by the angle at which they are seen from there, into 1024 bins of half
// a turn, and a line meets only the sides in its bin [Matusik, Buehler, McMillan 2001].
#include "apps/visual_hull/verify/sight_lines.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "apps/visual_hull/scene/pose.h"

namespace nef::visual_hull {
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
  normals_.reserve(u_.size());
  for (std::size_t k = 0; k < u_.size(); ++k) {  // those between rings are not asked for
    const std::size_t next = k + 1 < u_.size() ? k + 1 : 0;
    const Eigen::Vector3d side = Eigen::Vector3d(u_[k], v_[k], 1).cross(Eigen::Vector3d(u_[next], v_[next], 1));
    normals_.push_back(matrix_.leftCols<3>().transpose() * side);
  }
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
SightPencil::SightPencil(const SightView& view, const Eigen::Vector3d& centre) : view_(view) {
  const Eigen::Matrix3d block = view.matrix_.leftCols<3>();
  const Eigen::Vector3d image = view.matrix_ * centre.homogeneous();
  depth_ = image[2];
  const Eigen::Vector3d axis = centre - view.centre_;
  if (axis.squaredNorm() > 0) {
    across0_ = axis.unitOrthogonal();
    across1_ = axis.normalized().cross(across0_);
  } else {
    across0_ = across1_ = Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d form0 = image.cross(block * across0_);
  const Eigen::Vector3d form1 = image.cross(block * across1_);
  forms_.reserve(view.u_.size());
  heights_.reserve(view.u_.size());
  for (std::size_t k = 0; k < view.u_.size(); ++k) {
    forms_.push_back({form0[0] * view.u_[k] + form0[1] * view.v_[k] + form0[2],
                      form1[0] * view.u_[k] + form1[1] * view.v_[k] + form1[2]});
    heights_.push_back(view.normals_[k].dot(axis));
  }
  sort_sides_by_angle();
}

void SightPencil::sort_sides_by_angle() {
  std::vector<double> turns;
  turns.reserve(forms_.size());
  for (const Form& form : forms_) turns.push_back(turn_of(-form.y, form.x));
  // Twice over the sides: count, then fill.
  bin_begin_.assign(kBins + 1, 0);
  for (const bool fill : {false, true}) {
    for (std::size_t r = 0; r + 1 < view_.ring_begin_.size(); ++r) {
      for (std::uint32_t k = view_.ring_begin_[r]; k + 1 < view_.ring_begin_[r + 1]; ++k) {
        double step = turns[k + 1] - turns[k];
        if (std::abs(step) > 2) step -= std::copysign(4.0, step);  // the shorter way
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

// Where the line is in front of the camera it begins, or ends, at depth zero, which is seen infinitely far away and so
// outside of the silhouette; the other end, at infinity, is seen in a point that may lie inside.
void SightPencil::cut(const Eigen::Vector3d& direction, const DepthInterval& range, std::vector<double>& ends) const {
  ends.clear();
  double from = range.from;
  double to = range.to;
  const double slope = view_.matrix_.row(2).head<3>().dot(direction);
  if (slope > 0) from = std::max(from, -depth_ / slope);
  if (slope < 0) to = std::min(to, -depth_ / slope);
  if (!(from < to) || (slope == 0 && depth_ <= 0)) return;
  const double x = direction.dot(across0_);
  const double y = direction.dot(across1_);
  if (!(x * x + y * y > 1e-24 * direction.squaredNorm())) {
    // Both cameras stand on the line, which is seen as a point.
    const Eigen::Vector3d image = view_.matrix_.leftCols<3>() * direction * (slope < 0 ? -1 : 1);
    if (view_.inside(image.head<2>() / image[2])) ends = {from, to};
    return;
  }
  const std::size_t bin = static_cast<std::size_t>(turn_of(x, y) * kBinsOfQuarter) % kBins;
  for (std::uint32_t i = bin_begin_[bin]; i < bin_begin_[bin + 1]; ++i) {
    const std::uint32_t k = bin_sides_[i];
    if ((forms_[k].at(x, y) <= 0) == (forms_[k + 1].at(x, y) <= 0)) continue;
    const double s = -heights_[k] / view_.normals_[k].dot(direction);
    if (depth_ + s * slope > 0) ends.push_back(s);
  }
  std::sort(ends.begin(), ends.end());
  if (ends.size() % 2 != 0) {
    if (slope > 0) {
      ends.push_back(INFINITY);
    } else {
      ends.insert(ends.begin(), -INFINITY);
    }
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    const double enter = std::max(ends[k], from);
    const double leave = std::min(ends[k + 1], to);
    if (!(enter < leave)) continue;
    ends[kept++] = enter;
    ends[kept++] = leave;
  }
  ends.resize(kept);
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

}  // namespace nef::visual_hull
