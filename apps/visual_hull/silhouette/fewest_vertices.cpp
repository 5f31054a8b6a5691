// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/fewest_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace visual_hull {
namespace {

using Vec = std::array<double, 2>;

/// The directions from one point that pass within the tolerance of all points shown to it.
class Wedge {
 public:
  Wedge(const Vec& apex, double tolerance) : apex_(apex), tolerance_(tolerance) {}

  /// False if no direction is left.
  bool narrow(const Vec& p) {
    const double dx = p[0] - apex_[0];
    const double dy = p[1] - apex_[1];
    const double distance = std::hypot(dx, dy);
    if (distance <= tolerance_) return true;  // near the apex itself: any direction will do
    const double half = std::asin(std::min(1.0, tolerance_ / distance)) + kSlack;
    const double angle = std::atan2(dy, dx);
    if (!known_) {
      known_ = true;
      base_ = angle;
      low_ = -half;
      high_ = half;
      return true;
    }
    const double relative = std::remainder(angle - base_, 2 * M_PI);
    low_ = std::max(low_, relative - half);
    high_ = std::min(high_, relative + half);
    return low_ <= high_;
  }

  [[nodiscard]] bool admits(const Vec& p) const {
    if (!known_) return true;
    const double relative = std::remainder(std::atan2(p[1] - apex_[1], p[0] - apex_[0]) - base_, 2 * M_PI);
    return relative >= low_ - kSlack && relative <= high_ + kSlack;
  }

 private:
  static constexpr double kSlack = 1e-9;  // the wedge only saves work; distances decide
  Vec apex_;
  double tolerance_;
  bool known_ = false;
  double base_ = 0;
  double low_ = 0;
  double high_ = 0;
};

struct State {
  std::uint32_t count = std::numeric_limits<std::uint32_t>::max();
  double squares = 0;
  std::uint32_t from = 0;
};

class ShortestPath {
 public:
  // points.front() and points.back() are the same vertex.
  ShortestPath(std::vector<Vec> points, std::vector<bool> pinned, double tolerance)
      : points_(std::move(points)), pinned_(std::move(pinned)), tolerance_(tolerance), states_(points_.size()) {}

  std::vector<std::uint32_t> run() {
    states_[0].count = 0;
    for (std::uint32_t i = 0; i + 1 < points_.size(); ++i) extend(i);
    std::vector<std::uint32_t> path;
    for (auto i = static_cast<std::uint32_t>(points_.size() - 1); i != 0; i = states_[i].from) path.push_back(i);
    return path;
  }

 private:
  void extend(std::uint32_t i) {
    Wedge wedge(points_[i], tolerance_);
    for (std::uint32_t j = i + 1; j < points_.size(); ++j) {
      const std::uint32_t count = states_[i].count + 1;
      if (count <= states_[j].count && wedge.admits(points_[j])) relax(i, j, count);
      if (pinned_[j] || !wedge.narrow(points_[j])) return;
    }
  }

  void relax(std::uint32_t i, std::uint32_t j, std::uint32_t count) {
    double squares = states_[i].squares;
    for (std::uint32_t k = i + 1; k < j; ++k) {
      const double distance = distance_to_segment(points_[k], points_[i], points_[j]);
      if (distance > tolerance_) return;
      squares += distance * distance;
      if (count == states_[j].count && squares >= states_[j].squares) return;
    }
    if (count < states_[j].count || squares < states_[j].squares) states_[j] = {count, squares, i};
  }

  std::vector<Vec> points_;
  std::vector<bool> pinned_;
  double tolerance_;
  std::vector<State> states_;
};

}  // namespace

double distance_to_segment(const Vec& p, const Vec& a, const Vec& b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double length = dx * dx + dy * dy;
  double t = length > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length : 0.0;
  t = std::clamp(t, 0.0, 1.0);
  const double ex = p[0] - a[0] - t * dx;
  const double ey = p[1] - a[1] - t * dy;
  return std::sqrt(ex * ex + ey * ey);
}

std::vector<bool> fewest_vertices(const Ring& ring, const std::vector<bool>& pinned, double tolerance) {
  const auto n = static_cast<std::uint32_t>(ring.size());
  std::uint32_t start = 0;  // an extreme vertex, unless one is pinned: likely to be kept anyway
  for (std::uint32_t i = 1; i < n; ++i) {
    if (pinned[start]) break;
    if (pinned[i] || ring[i].approximate < ring[start].approximate) start = i;
  }
  std::vector<Vec> points;
  std::vector<bool> fixed;
  for (std::uint32_t i = 0; i <= n; ++i) {
    points.push_back(ring[(start + i) % n].approximate);
    fixed.push_back(pinned[(start + i) % n]);
  }
  std::vector<bool> keep(n, false);
  for (const std::uint32_t i : ShortestPath(std::move(points), std::move(fixed), tolerance).run()) {
    keep[(start + i) % n] = true;
  }
  return keep;
}

}  // namespace visual_hull
