// SPDX-License-Identifier: Apache-2.0
//
// Each solid is drawn on a grid of its own, of equal cubes, as `planar/covered_cells` does it for polygons: the pieces
// of facets are clipped to layers and rows, and what they come near is on the border. All other cubes are wholly inside
// or wholly outside, told row by row by the parity of the pieces that the middle of the row passes. A cube of A and one
// of B, both closed and in the insides, have a block of eight cubes as their sum, in int A + int B (`BitGrid::sum`).
//
// Errors: with coordinates of magnitude M, rounded corners, their sums and their places in the grid are off by less
// than 2^-44 M, which must be less than a sixteenth of a cube, as must be twice an error that `cover` is told; clipping
// adds a few units of 2^-53 of the places, which are below 2^11. Cubes count as met within an eighth of their size.
// Where the middle of a row passes an edge on the other side than in truth, it does so for both pieces beside that
// edge: each edge is asked the same, bit by bit.
#include "apps/minkowski/convolution/facets/covered_voxels.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "nef/base/threads/parallel.h"

namespace nef::minkowski {
namespace {

constexpr double kNear = 0.125;
constexpr std::uint32_t kFewest = 8;  // cubes along a side

// The part of a convex polygon with low <= coordinate <= high.
void clip(const std::vector<Double3>& polygon, std::size_t axis, double low, double high, std::vector<Double3>& half,
          std::vector<Double3>& result) {
  const auto keep = [axis](const std::vector<Double3>& from, double sign, double bound, std::vector<Double3>& to) {
    to.clear();
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Double3& p = from[i];
      const Double3& q = from[i + 1 < from.size() ? i + 1 : 0];
      const double of_p = sign * (p[axis] - bound);
      const double of_q = sign * (q[axis] - bound);
      if (of_p >= 0) to.push_back(p);
      if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0)) {
        const double t = of_p / (of_p - of_q);
        to.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
      }
    }
  };
  keep(polygon, 1, low, half);
  keep(half, -1, high, result);
}

struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  [[nodiscard]] std::uint32_t first() const { return cell_of(low - kNear); }
  [[nodiscard]] std::uint32_t last() const { return cell_of(high + kNear); }
};

Range range_of(const std::vector<Double3>& polygon, std::size_t axis) {
  Range range;
  for (const Double3& p : polygon) {
    range.low = std::min(range.low, p[axis]);
    range.high = std::max(range.high, p[axis]);
  }
  return range;
}

// Calls visit(range of x, y, z) for each row of cubes that a convex polygon comes near, until it returns false.
// Coordinates are places in the grid. False if it did.
template <typename Visit>
bool for_each_row(const std::vector<Double3>& polygon, Visit&& visit) {
  std::vector<Double3> half;
  std::vector<Double3> layer;
  std::vector<Double3> row;
  const Range of_z = range_of(polygon, 2);
  for (std::uint32_t z = of_z.first(); z <= of_z.last(); ++z) {
    const bool is_whole_layer = of_z.first() == of_z.last();
    if (!is_whole_layer) clip(polygon, 2, z - kNear, z + 1 + kNear, half, layer);
    const std::vector<Double3>& in_layer = is_whole_layer ? polygon : layer;
    if (in_layer.empty()) continue;
    const Range of_y = range_of(in_layer, 1);
    for (std::uint32_t y = of_y.first(); y <= of_y.last(); ++y) {
      const bool is_whole_row = of_y.first() == of_y.last();
      if (!is_whole_row) clip(in_layer, 1, y - kNear, y + 1 + kNear, half, row);
      const std::vector<Double3>& in_row = is_whole_row ? in_layer : row;
      if (!in_row.empty() && !visit(range_of(in_row, 0), y, z)) return false;
    }
  }
  return true;
}

// True if the ray from (y, z) towards larger y passes an edge, as seen along x. The same for both directions of the
// edge.
bool passes(const Double3& a, const Double3& b, double y, double z) {
  const auto& [p, q] = a < b ? std::tie(a, b) : std::tie(b, a);
  if ((p[2] <= z) == (q[2] <= z)) return false;
  return p[1] + (z - p[2]) * ((q[1] - p[1]) / (q[2] - p[2])) > y;
}

bool is_over(const std::vector<Double3>& polygon, double y, double z) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (passes(polygon[i], polygon[i + 1 < polygon.size() ? i + 1 : 0], y, z)) inside = !inside;
  }
  return inside;
}

struct Extent {
  Double3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double magnitude = 0;
};

std::vector<Double3> rounded_points(const SolidFeatures& solid) {
  std::vector<Double3> result;
  for (const Rational3& p : solid.points()) result.push_back(nearest_doubles(p));
  return result;
}

Extent extent_of(const std::vector<Double3>& points) {
  Extent extent;
  for (const Double3& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      extent.low[i] = std::min(extent.low[i], p[i]);
      extent.high[i] = std::max(extent.high[i], p[i]);
      extent.magnitude = std::max(extent.magnitude, std::fabs(p[i]));
    }
  }
  return extent;
}

}  // namespace

CoveredVoxels::CoveredVoxels(const SolidFeatures& a, const SolidFeatures& b, std::uint32_t cells,
                             const Monitor& monitor) {
  double longest = 0;
  double magnitude = 0;
  for (const SolidFeatures* solid : {&a, &b}) {
    const Extent extent = extent_of(rounded_points(*solid));
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, extent.high[i] - extent.low[i]);
    magnitude += extent.magnitude;
  }
  for (; cells >= kFewest; cells /= 2) {
    size_ = longest / cells;
    if (!(magnitude * 0x1p-44 < size_ / 16) || !(size_ > 1e-280) || !(longest < 1e280)) break;
    Raster of_a;
    Raster of_b;
    parallel_calls(monitor, {[&](const Monitor& own) { of_a = raster_of(a, own); },
                             [&](const Monitor& own) { of_b = raster_of(b, own); }});
    std::optional<BitGrid> sum = BitGrid::sum(of_a.inside, of_b.inside);
    if (!sum) continue;
    for (std::size_t i = 0; i < 3; ++i) low_[i] = of_a.low[i] + of_b.low[i];
    covered_ = *std::move(sum);
    return;
  }
  size_ = 0;
}

// What some pieces come near, and where the middles of rows pass them.
struct CoveredVoxels::Drawing {
  struct Passed {
    std::size_t row = 0;
    double at = 0;
  };
  BitGrid border;
  std::vector<Passed> passed;
};

void CoveredVoxels::draw(const std::vector<Double3>& polygon, Drawing& drawing) {
  const std::uint32_t height = drawing.border.size()[1];
  for_each_row(polygon, [&](const Range& of_x, std::uint32_t y, std::uint32_t z) {
    for (std::uint32_t x = of_x.first(); x <= of_x.last(); ++x) drawing.border.set(x, y, z);
    if (is_over(polygon, y + 0.5, z + 0.5)) {
      drawing.passed.push_back({std::size_t{z} * height + y, (of_x.low + of_x.high) / 2});
    }
    return true;
  });
}

CoveredVoxels::Raster CoveredVoxels::raster_of(const SolidFeatures& solid, const Monitor& monitor) const {
  std::vector<Double3> points = rounded_points(solid);
  const Extent extent = extent_of(points);
  Raster result;
  std::array<std::uint32_t, 3> count{};
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] = extent.low[i] - size_;
    count[i] = static_cast<std::uint32_t>((extent.high[i] - extent.low[i]) / size_) + 3;
    for (Double3& p : points) p[i] = (p[i] - result.low[i]) / size_;
  }
  // A grid for each range, of so many facets that to unite them is nothing beside drawing.
  constexpr std::size_t kRange = 16384;
  const std::vector<SolidFacet>& facets = solid.facets();
  std::vector<Drawing> drawings((facets.size() + kRange - 1) / kRange);
  parallel_for_ranges(facets.size(), kRange, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
    Drawing& drawing = drawings[from / kRange];
    drawing.border = BitGrid(count[0], count[1], count[2]);
    std::vector<Double3> polygon;
    for (std::size_t f = from; f < to; ++f) {
      for (const FacetPiece& piece : facets[f].pieces) {
        polygon.clear();
        for (const std::uint32_t v : piece.ring) polygon.push_back(points[v]);
        draw(polygon, drawing);
      }
    }
  });
  BitGrid border(count[0], count[1], count[2]);
  std::vector<std::vector<double>> passed(std::size_t{count[1]} * count[2]);
  for (const Drawing& drawing : drawings) {
    border.unite(drawing.border);
    for (const auto& [row, at] : drawing.passed) passed[row].push_back(at);
  }
  result.inside = cells_inside(border, std::move(passed));
  return result;
}

bool CoveredVoxels::cover(std::span<const Double3> polygon, double error) const {
  if (size_ == 0 || !(error < size_ / 32)) return false;
  std::vector<Double3> placed;
  for (const Double3& p : polygon) {
    Double3& place = placed.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      place[i] = (p[i] - low_[i]) / size_;
      if (!(place[i] >= 1 && place[i] < covered_.size()[i] - 1)) return false;
    }
    if (!covered_.has(cell_of(place[0]), cell_of(place[1]), cell_of(place[2]))) return false;
  }
  return for_each_row(placed, [&](const Range& of_x, std::uint32_t y, std::uint32_t z) {
    for (std::uint32_t x = of_x.first(); x <= of_x.last(); ++x) {
      if (!covered_.has(x, y, z)) return false;
    }
    return true;
  });
}

}  // namespace nef::minkowski
