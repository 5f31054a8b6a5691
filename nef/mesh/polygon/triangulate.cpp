// SPDX-License-Identifier: Apache-2.0
//
// Convex rings, told by the turns of their corners, become fans; other polygons are swept, or lose their ears, if they
// are small and have no holes. Rings of faces are looked at along the axis along which they look largest, or else along
// another one.
#include "nef/mesh/polygon/triangulate.h"

#include <algorithm>
#include <cmath>

#include "nef/complex/facet_plane.h"

namespace nef {
namespace {

// The coordinate axes, the one along which a polygon looks largest first, by its area vector in doubles.
std::array<std::size_t, 3> projection_axes(const MeshPoints& points, const std::vector<std::uint32_t>& ring) {
  std::array<double, 3> area{};
  const auto& origin = points.approximate(ring[0]);
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const auto& p = points.approximate(ring[i]);
    const auto& q = points.approximate(ring[i + 1]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3;
      const std::size_t k = (axis + 2) % 3;
      area[axis] += (p[j] - origin[j]) * (q[k] - origin[k]) - (p[k] - origin[k]) * (q[j] - origin[j]);
    }
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  const auto swap_unless_larger = [&](std::size_t i) {
    if (std::abs(area[order[i]]) < std::abs(area[order[i + 1]])) std::swap(order[i], order[i + 1]);
  };
  for (const std::size_t i : {0, 1, 0}) swap_unless_larger(i);
  return order;
}

}  // namespace

ProjectionAxis projection_axis(const PlaneTable& planes, PlaneId plane) {
  const PlaneAxes axes(planes, plane);
  return {static_cast<std::size_t>(axes.dropped), axes.positive != plane.flipped() ? 1 : -1};
}

int ring_orientation(const MeshPoints& points, const std::vector<std::uint32_t>& ring, std::size_t axis,
                     const Monitor& monitor) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  std::size_t best = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const int order = points.compare(ring[i], ring[best], u);
    if (order < 0 || (order == 0 && points.compare(ring[i], ring[best], v) < 0)) best = i;
  }
  const std::size_t n = ring.size();
  return points.orientation_along(ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n], axis, monitor);
}

// Of a ring whose corners all turn left by less than half a turn, so that four cannot go around twice: it goes around
// once if it rises once and falls once.
bool Triangulator::goes_around_once() const {
  const auto n = static_cast<std::uint32_t>(projected_.size());
  if (n <= 4) return true;
  std::uint32_t peaks = 0;
  bool rose = projected_.before(projected_[n - 1], projected_[0]);
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool rises = projected_.before(projected_[i], projected_[i + 1 == n ? 0 : i + 1]);
    peaks += rose && !rises ? 1 : 0;
    rose = rises;
  }
  return peaks == 1;
}

bool Triangulator::is_convex() const {
  const auto n = static_cast<std::uint32_t>(projected_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!projected_.turns_left(i == 0 ? n - 1 : i - 1, i, i + 1 == n ? 0 : i + 1)) return false;
  }
  return goes_around_once();
}

bool Triangulator::is_convex(std::span<const std::uint32_t> ring, std::size_t axis) {
  const int turn = points_.orientation_along(ring.back(), ring[0], ring[1], axis, monitor_);
  if (turn == 0) return false;
  projected_.assign(ring, axis, turn);
  return is_convex();
}

Triangulator::Cut Triangulator::cut(const std::vector<std::uint32_t>& ring, std::vector<Triangle>& out) {
  for (const std::size_t axis : projection_axes(points_, ring)) {
    // A ring that is convex there has its triangles over disjoint triangles there, planar or not.
    if (is_convex(ring, axis)) {
      cut_convex(ring, out);
      return Cut::kConvex;
    }
    const int sign = ring_orientation(points_, ring, axis, monitor_);
    if (sign != 0 && triangulate(ring, axis, sign, out)) return Cut::kDone;
  }
  return Cut::kFailed;
}

// Two triangles on both sides of a diagonal are the polygon if both turn left.
bool Triangulator::cut_four(std::vector<Triangle>& out) const {
  if (projected_.turns_left(3, 0, 1) && projected_.turns_left(1, 2, 3)) {
    push(3, 0, 1, out);
    push(1, 2, 3, out);
    return true;
  }
  if (!projected_.turns_left(0, 1, 2) || !projected_.turns_left(2, 3, 0)) return false;
  push(0, 1, 2, out);
  push(2, 3, 0, out);
  return true;
}

bool Triangulator::triangulate(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> ring_end,
                               std::size_t axis, int sign, std::vector<Triangle>& out) {
  if (ring_end.empty() || ring_end[0] < 3) return false;
  projected_.assign(corners, axis, sign);
  if (ring_end.size() == 1 && corners.size() == 4) return cut_four(out);
  const std::size_t old = out.size();
  if (ring_end.size() == 1) {
    const bool is_small = corners.size() <= EarClipper::kSmall;
    const std::uint32_t blunt = is_small ? projected_.blunt_corners() : 0;
    if (is_small ? blunt == 0 && goes_around_once() : is_convex()) {
      cut_convex(corners, out);
      return true;
    }
    if (is_small && EarClipper::triangulate_small(projected_, blunt, out)) return true;
    out.resize(old);
  }
  if (sweep_.triangulate(projected_, ring_end, out)) return true;
  out.resize(old);
  return false;
}

bool Triangulator::triangulate(std::span<const std::vector<std::uint32_t>> rings, std::size_t axis, int sign,
                               std::vector<Triangle>& out) {
  corners_.clear();
  ring_end_.clear();
  for (const std::vector<std::uint32_t>& ring : rings) {
    if (ring.empty()) return false;
    corners_.insert(corners_.end(), ring.begin(), ring.end());
    ring_end_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }
  return triangulate(corners_, ring_end_, axis, sign, out);
}

bool Triangulator::triangulate(std::span<const std::uint32_t> ring, std::size_t axis, int sign,
                               std::vector<Triangle>& out) {
  if (ring.size() < 3) return false;
  projected_.assign(ring, axis, sign);
  const std::size_t old = out.size();
  if (ears_.triangulate(projected_, out)) return true;
  out.resize(old);
  return false;
}

// Cuts off every second corner, round after round, as EarClipper does where nothing is in the way.
void Triangulator::cut_convex(std::span<const std::uint32_t> ring, std::vector<Triangle>& out) {
  // A queue, whose first corner is the one before that which is cut off.
  queue_.resize(2 * ring.size());
  queue_[0] = ring.back();
  std::copy(ring.begin(), ring.end() - 1, queue_.begin() + 1);
  std::size_t first = 0;
  for (std::size_t last = ring.size(); last < 2 * ring.size() - 2; ++last) {
    out.push_back({queue_[first], queue_[first + 1], queue_[first + 2]});
    queue_[last] = queue_[first];
    first += 2;
  }
}

}  // namespace nef
