// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/fewest_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nef::visual_hull {
namespace {

using Vec = std::array<double, 2>;

double square_to_segment(const Vec& p, const Vec& a, const Vec& b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double length = dx * dx + dy * dy;
  double t = length > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length : 0.0;
  t = std::clamp(t, 0.0, 1.0);
  const double ex = p[0] - a[0] - t * dx;
  const double ey = p[1] - a[1] - t * dy;
  return ex * ex + ey * ey;
}

double determinant(const Vec& a, const Vec& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The directions from one point that pass within the tolerance of all points shown to it: a wedge of less than half a
/// turn.
class Wedge {
 public:
  Wedge(const Vec& apex, double tolerance) : apex_(apex), tolerance_(tolerance) {}

  /// False if no direction is left.
  bool narrow(const Vec& p) {
    const double dx = p[0] - apex_[0];
    const double dy = p[1] - apex_[1];
    const double square = dx * dx + dy * dy;
    const double reach = tolerance_ * (1 + kSlack);
    if (square <= reach * reach) return true;  // near the apex itself: any direction will do
    const double distance = std::sqrt(square);
    const double sine = reach / distance;
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    const Vec low{dx * cosine + dy * sine, dy * cosine - dx * sine};
    const Vec high{dx * cosine - dy * sine, dy * cosine + dx * sine};
    if (!known_) {
      known_ = true;
      low_ = low;
      high_ = high;
      return true;
    }
    const bool low_inside = within(low, low_, high_);
    if (!low_inside && !within(low_, low, high)) return false;
    if (low_inside) low_ = low;
    if (within(high, low_, high_)) high_ = high;
    return true;
  }

  [[nodiscard]] bool admits(const Vec& p) const {
    return !known_ || within({p[0] - apex_[0], p[1] - apex_[1]}, low_, high_);
  }

 private:
  static constexpr double kSlack = 1e-9;  // the wedge only saves work; distances decide
  static bool within(const Vec& v, const Vec& low, const Vec& high) {
    return determinant(low, v) >= 0 && determinant(v, high) >= 0;
  }

  Vec apex_;
  double tolerance_;
  bool known_ = false;
  Vec low_{};
  Vec high_{};
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
    const double limit = tolerance_ * tolerance_ * (1 - 1e-12);  // a distance that passes does so with its rounding
    for (std::uint32_t k = i + 1; k < j; ++k) {
      const double square = square_to_segment(points_[k], points_[i], points_[j]);
      if (square > limit) return;
      squares += square;
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

double distance_to_segment(const Vec& p, const Vec& a, const Vec& b) { return std::sqrt(square_to_segment(p, a, b)); }

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

}  // namespace nef::visual_hull
