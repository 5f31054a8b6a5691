// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/cuts/halving_plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "nef/tiles/tile_tree.h"

namespace nef {
namespace {

// The number in (low, high] with the fewest binary digits; low < high.
double shortest_between(double low, double high) {
  if (low < 0 && high >= 0) return 0;
  if (high < 0) {
    const double mirrored = shortest_between(-high, -low);
    if (mirrored < -low) return -mirrored;
    return high;
  }
  for (int exponent = std::ilogb(high); exponent >= -1074; --exponent) {
    const double unit = std::ldexp(1.0, exponent);
    const double candidate = std::floor(high / unit) * unit;
    if (candidate > low) return candidate;
  }
  return high;
}

}  // namespace

std::optional<AxisPlane> halving_plane(const Complex& complex, std::size_t attempt) {
  std::vector<std::array<double, 3>> inner;
  inner.reserve(complex.vertex_count());
  BoundaryVertices has_boundary_at(complex);
  for (const VertexId v : complex.vertex_ids()) {
    if (!has_boundary_at(v) || !complex.points.finite(point_of(v))) continue;
    const std::array<double, 3>& p = complex.points.approximate(point_of(v));
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) inner.push_back(p);
  }
  return halving_plane(inner, attempt);
}

std::optional<AxisPlane> halving_plane(std::span<const std::array<double, 3>> places, std::size_t attempt) {
  if (places.empty()) return std::nullopt;
  Box box;
  for (const std::array<double, 3>& p : places) {
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = std::min(box.low[i], p[i]);
      box.high[i] = std::max(box.high[i], p[i]);
    }
  }
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&box](std::size_t a, std::size_t b) {
    return box.high[a] - box.low[a] > box.high[b] - box.low[b];
  });
  const std::size_t axis = axes[attempt];
  if (!(box.low[axis] < box.high[axis])) return std::nullopt;
  std::vector<double> x;
  x.reserve(places.size());
  for (const std::array<double, 3>& p : places) x.push_back(p[axis]);
  const auto quantile = [&x](std::size_t k) {
    std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(k), x.end());
    return x[k];
  };
  const double low = quantile(x.size() * 45 / 100);
  double high = quantile(x.size() * 55 / 100);
  // Many vertices may share the coordinate in the middle; the largest one leaves nothing above it.
  double at = low < high ? shortest_between(low, high) : low;
  if (!(at > box.low[axis])) at = shortest_between(box.low[axis], box.high[axis]);
  if (!(at < box.high[axis])) at = shortest_between(box.low[axis], std::nextafter(box.high[axis], box.low[axis]));
  if (!(at > box.low[axis] && at < box.high[axis])) return std::nullopt;
  return AxisPlane(axis, exact_rational(at));
}

}  // namespace nef
