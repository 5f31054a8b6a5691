// SPDX-License-Identifier: Apache-2.0
//
// Each polygon is drawn on a grid of its own, of equal squares: what a side comes near is on the border, all other
// squares are wholly inside or wholly outside, told row by row by the parity of the sides to the left of their middles.
// A square of P and one of Q, both closed and in the insides, have a closed block of four squares as their sum, in the
// inside of P + Q
// (`BitGrid::sum`): O(cells^3 / 64) for polygons with few runs of squares a row.
//
// Errors: coordinates of magnitude M are off by 2^-53 M, places in the grid by a few units of that, and the slack is
// 2^-44 M, which must be less than a sixteenth of a square. The middle of a row may pass a corner on the other side
// than in truth; but the border squares hold a neighbourhood of that corner, so the parity of other squares does not
// change.
#include "apps/minkowski/planar/covered_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nef::minkowski {
namespace {

std::array<double, 2> seen(const Rational3& point, const PlanarFrame& frame) {
  return {nearest_double(point[first_axis(frame)]), nearest_double(point[second_axis(frame)])};
}

struct Extent {
  std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  double magnitude = 0;
};

Extent extent_of(const PlanarPolygon& polygon, const PlanarFrame& frame) {
  Extent extent;
  for (const Rational3& corner : polygon.corners) {
    const std::array<double, 2> at = seen(corner, frame);
    for (std::size_t i = 0; i < 2; ++i) {
      extent.low[i] = std::min(extent.low[i], at[i]);
      extent.high[i] = std::max(extent.high[i], at[i]);
      extent.magnitude = std::max(extent.magnitude, std::fabs(at[i]));
    }
  }
  return extent;
}

}  // namespace

CoveredCells::CoveredCells(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame,
                           std::uint32_t cells) {
  const Extent of_p = extent_of(p, frame);
  const Extent of_q = extent_of(q, frame);
  double longest = 0;
  for (const Extent* e : {&of_p, &of_q}) {
    for (std::size_t i = 0; i < 2; ++i) longest = std::max(longest, e->high[i] - e->low[i]);
  }
  const double size = longest / std::min<std::uint32_t>(cells, 1024);
  slack_ = (of_p.magnitude + of_q.magnitude) * 0x1p-44;
  if (!(slack_ < size / 16) || !(size > 1e-280) || !(longest < 1e280)) return;
  size_ = size;
  const Raster raster_p = raster_of(p, frame);
  const Raster raster_q = raster_of(q, frame);
  for (std::size_t i = 0; i < 2; ++i) low_[i] = raster_p.low[i] + raster_q.low[i];
  if (std::optional<BitGrid> sum = BitGrid::sum(raster_p.inside, raster_q.inside)) {
    covered_ = *std::move(sum);
  } else {
    size_ = 0;
  }
}

CoveredCells::Raster CoveredCells::raster_of(const PlanarPolygon& polygon, const PlanarFrame& frame) const {
  const Extent extent = extent_of(polygon, frame);
  Raster result;
  std::array<std::uint32_t, 2> count{};
  for (std::size_t i = 0; i < 2; ++i) {
    result.low[i] = extent.low[i] - size_;
    count[i] = static_cast<std::uint32_t>((extent.high[i] - extent.low[i]) / size_) + 3;
  }
  BitGrid border(count[0], count[1], 1);
  std::vector<std::vector<double>> crossed(count[1]);  // where the middle of each row meets sides
  const auto place = [&](const Rational3& corner) {
    std::array<double, 2> at = seen(corner, frame);
    for (std::size_t i = 0; i < 2; ++i) at[i] = (at[i] - result.low[i]) / size_;
    return at;
  };
  constexpr double kNear = 0.125;  // more than the slack
  for (std::size_t ring = 0, c = 0; ring < polygon.ring_end.size(); ++ring) {
    for (; c < polygon.ring_end[ring]; ++c) {
      std::array<double, 2> a = place(polygon.corners[c]);
      std::array<double, 2> b = place(polygon.corners[polygon.next(ring, static_cast<std::uint32_t>(c))]);
      if (a[1] > b[1]) std::swap(a, b);
      const double slope = b[1] > a[1] ? (b[0] - a[0]) / (b[1] - a[1]) : 0;
      const std::uint32_t last = std::min(cell_of(b[1] + kNear), count[1] - 1);
      for (std::uint32_t y = cell_of(a[1] - kNear); y <= last; ++y) {
        // The part of the side in this row and near it; for one that hardly rises, all of it.
        double from = std::min(a[0], b[0]);
        double to = std::max(a[0], b[0]);
        if (b[1] - a[1] > 1) {
          const double at_low = a[0] + slope * (y - 2 * kNear - a[1]);
          const double at_high = a[0] + slope * (y + 1 + 2 * kNear - a[1]);
          from = std::max(from, std::min(at_low, at_high));
          to = std::min(to, std::max(at_low, at_high));
        }
        const std::uint32_t end = std::min(cell_of(to + kNear), count[0] - 1);
        for (std::uint32_t x = cell_of(from - kNear); x <= end; ++x) border.set(x, y, 0);
        const double middle = y + 0.5;
        if ((a[1] <= middle) != (b[1] <= middle)) crossed[y].push_back(a[0] + slope * (middle - a[1]));
      }
    }
  }
  result.inside = cells_inside(border, std::move(crossed));
  return result;
}

bool CoveredCells::cover(const std::array<double, 2>& from, const std::array<double, 2>& to) const {
  if (size_ == 0) return false;
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  for (std::size_t i = 0; i < 2; ++i) {
    low[i] = (std::min(from[i], to[i]) - slack_ - low_[i]) / size_;
    high[i] = (std::max(from[i], to[i]) + slack_ - low_[i]) / size_;
  }
  if (!(low[0] >= 0 && low[1] >= 0 && high[0] < covered_.size()[0] && high[1] < covered_.size()[1])) return false;
  for (std::uint32_t y = cell_of(low[1]); y <= cell_of(high[1]); ++y) {
    for (std::uint32_t x = cell_of(low[0]); x <= cell_of(high[0]); ++x) {
      if (!covered_.has(x, y, 0)) return false;
    }
  }
  return true;
}

}  // namespace nef::minkowski
